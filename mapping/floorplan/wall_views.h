// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/floorplan/wall_scan.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

/// The walls in a drive's views (frame a: level), at most `max_views` of them, evenly spread. The same for any number of threads.
[[nodiscard]] WallSketch sketchWalls(const std::vector<View>& views_level, const FusionInput& input, const DepthFilterConfig& filter,
                                     const WallScanConfig& config);

}  // namespace oikos::mapping
