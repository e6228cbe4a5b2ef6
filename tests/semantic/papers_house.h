// SPDX-License-Identifier: Apache-2.0
// The sample home that the papers describe: a kitchen with a table, a cupboard and a fridge, and a bathroom.
#pragma once

#include <filesystem>

#include "semantic/model/home.h"
#include "semantic/xml/home_reader.h"

namespace oikos::semantic {

[[nodiscard]] inline Home papersHouse() {
  return readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml").home;
}

}  // namespace oikos::semantic
