// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace oikos::bench {

/// How far each joint of a home can be opened before its part meets a wall of the room or another piece (degrees or m): a door that was
/// made to turn by 110 degrees turns no farther than the wall beside it lets it. By joint, those of room doors left out.
[[nodiscard]] std::map<std::string, double> freeUppers(const std::filesystem::path& home_folder);

}  // namespace oikos::bench
