// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octomap/OcTree.h>

#include <memory>

#include "mapping/volume/occupancy_integrator.h"

namespace oikos::mapping {

/// The pruned octree with the integrator's voxels, log-odds and sensor model, inner nodes updated: node for node what OctoMap
/// has after inserting the same scans with `lazy_eval` off.
[[nodiscard]] std::unique_ptr<octomap::OcTree> makeOctomapTree(const OccupancyIntegrator& occupancy);

}  // namespace oikos::mapping
