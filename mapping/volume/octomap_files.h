// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mapping/volume/occupancy_integrator.h"

namespace oikos::mapping {

/// Writes `octomap.bt` (most likely state of each voxel) and `octomap.ot` (log-odds) into an existing folder, in OctoMap's own
/// formats, pruned. Each file is atomic; throws Error{kIo} with its path when the disk refuses it.
void writeOctomap(const OccupancyIntegrator& occupancy, const std::filesystem::path& folder);

}  // namespace oikos::mapping
