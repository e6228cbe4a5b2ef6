// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/volume/voxel_key.h"

namespace oikos::mapping {

/// A step from a voxel to another one.
struct VoxelStep {
  VoxelKey offset;
  double length_m;
};

/// Steps to all voxels whose centres are within `radius_m`, the own one first, nearer ones before farther ones.
[[nodiscard]] std::vector<VoxelStep> voxelBall(double radius_m, double resolution_m);

/// The voxel that the step leads to; beyond the lattice it comes back in at the other side.
constexpr VoxelKey stepFrom(VoxelKey key, VoxelKey offset) {
  return (key + offset) & kVoxelKeyMask;
}

}  // namespace oikos::mapping
