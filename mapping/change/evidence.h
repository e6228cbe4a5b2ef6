// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "mapping/change/change_config.h"
#include "mapping/change/scan_view.h"
#include "mapping/change/seen_space.h"
#include "mapping/change/voxel_ball.h"

namespace oikos::mapping {

/// What scans say about a voxel that may have changed.
struct Evidence {
  Eigen::Vector3d point_map = Eigen::Vector3d::Zero();  ///< new: where the surface is in the voxel; gone: its centre
  bool is_seed = false;                                 ///< clear by the whole tolerance; else by half of it
  double clear_sigmas = 0.0;                            ///< the most that any scan gives
  int for_views = 0;                                    ///< scans that see the change
  int against_views = 0;                                ///< scans that see the voxel as the map has it
};
/// Ordered, so that results do not depend on who came first.
using EvidenceMap = std::map<VoxelKey, Evidence>;

/// What a scan measured in a voxel.
struct SurfaceVoxel {
  VoxelKey key;
  Eigen::Vector3d point_camera;  ///< mean of the readings
};

/// Voxels with `min_points` readings of surfaces or more, in ascending order of keys.
[[nodiscard]] std::vector<SurfaceVoxel> findSurface(const LocatedScan& scan, const ChangeConfig& config, const VoxelLattice& lattice);

/// One scan against the map.
struct ScanEvidence {
  EvidenceMap fresh;      ///< surface where the map was seen free, with all its neighbours within the tolerance
  EvidenceMap gone;       ///< surface of the map that the scan sees through, or (`against_views`) still sees
  int surface = 0;        ///< voxels of the scan's surface, not counting those that are too uncertain
  int surface_known = 0;  ///< of these: in space that the map knows
  int surface_fresh = 0;  ///< of these: seeds
  int map_seen = 0;       ///< occupied voxels of the map that the scan sees or sees through
  int map_gone = 0;       ///< of these: seen through
};

/// What scans are compared with.
struct Reference {
  const SeenSpace& space;
  const std::vector<VoxelKey>& occupied;
  const std::vector<VoxelStep>& ball;  ///< up to the greatest tolerance
};

[[nodiscard]] ScanEvidence compareScan(const ScanView& view, const std::vector<SurfaceVoxel>& surface, const Reference& reference);

}  // namespace oikos::mapping
