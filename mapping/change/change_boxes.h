// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <vector>

#include "mapping/change/change_finder.h"
#include "mapping/change/evidence.h"

namespace oikos::mapping {

/// Voxels with surfaces that a change may stand on.
using SupportVoxels = std::set<VoxelKey>;

/// Joins changed voxels to boxes. Voxels that most views do not agree on, boxes of few voxels and slivers are dropped.
/// `support`: for new things the map's surface, for gone ones the surface that is seen now.
[[nodiscard]] std::vector<Change> boxChanges(ChangeKind kind, const EvidenceMap& evidence, const SupportVoxels& support,
                                             const VoxelLattice& lattice, const ChangeConfig& config);

}  // namespace oikos::mapping
