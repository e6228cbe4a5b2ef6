// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semantic/model/finding.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

struct HomeReading {
  bool complete = false;  ///< the file was read to its end; `home` is what stands in it, right or wrong
  Home home;
  std::vector<Finding> findings;
};

/// Reads home.xml: what the schema refuses and what checkHome finds, all of it, in the order of the lines. Throws Error{kIo} if the file
/// cannot be read.
[[nodiscard]] HomeReading readHome(const std::filesystem::path& file);

/// The same for text at hand; `where` names it in errors.
[[nodiscard]] HomeReading readHomeText(const std::string& text, const std::string& where);

/// The home of a reading without errors. Throws Error{kInput} with the first error; `file` is where it was read from.
[[nodiscard]] Home getHome(HomeReading reading, const std::filesystem::path& file);

}  // namespace oikos::semantic
