// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "mapping/change/seen_space.h"

namespace oikos::mapping {

/// What a saved map knows of free and occupied space, from the depth images of its keyframes. `file`: a `keyframes.sqlite`. Costs about
/// as much as making the map's occupancy anew, and 10 bytes a voxel. Throws Error as KeyframeReader. The same for any number of threads.
[[nodiscard]] SeenSpace recallSpace(const std::filesystem::path& file, const OccupancyConfig& occupancy, const FreeSpaceConfig& free,
                                    int threads, const base::ProgressSink& progress = {});

}  // namespace oikos::mapping
