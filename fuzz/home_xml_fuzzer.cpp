// SPDX-License-Identifier: Apache-2.0
// Any bytes as home.xml: read, and what was read is indexed and written back as a whole.
#include <cstddef>
#include <cstdint>
#include <string>

#include "semantic/query/home_index.h"
#include "semantic/xml/home_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace oikos::semantic;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const HomeReading reading = readHomeText(text, "home.xml");
  if (reading.complete && reading.findings.empty()) {
    const HomeIndex index(reading.home);
    for (std::uint32_t number = 0; number < index.size(); ++number) {
      (void)index.thing(number).T_map_thing();
    }
  }
  return 0;
}
