// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "mapping/report/report.h"

namespace oikos::mapping {

/// What a map's own report says about how it came to be.
struct EarlierDrives {
  std::vector<DriveFacts> drives;  ///< in their order; at least one
  bool is_floor_found = false;
};

/// From a `report.json`; one without `drives` is of one drive of so many frames. Throws Error{kInput} that names the key.
[[nodiscard]] EarlierDrives readEarlierDrives(const std::filesystem::path& file, int frames);

}  // namespace oikos::mapping
