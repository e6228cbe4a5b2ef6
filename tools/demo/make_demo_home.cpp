// SPDX-License-Identifier: Apache-2.0
// Prints homes/demo/home.xml.
#include <iostream>

#include "semantic/xml/home_writer.h"
#include "tools/demo/demo_home.h"

int main() {
  std::cout << oikos::semantic::toXml(oikos::demo::makeDemoHome());
}
