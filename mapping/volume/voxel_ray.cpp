// SPDX-License-Identifier: Apache-2.0
//
// Repeats OctoMap's computeRayKeys operation by operation in the same types, so that the voxels are the same to the last ray;
// compiled without contraction of floating-point expressions (set in CMakeLists.txt).
#include "mapping/volume/voxel_ray.h"

#include <algorithm>
#include <limits>

namespace oikos::mapping {

namespace {

/// The state of the traversal along one axis.
struct Axis {
  double t_next = std::numeric_limits<double>::max();   ///< ray length at which the next voxel along this axis begins
  double t_voxel = std::numeric_limits<double>::max();  ///< ray length per voxel
  VoxelKey step = 0;                                    ///< added to the key under kVoxelKeyMask
};

Axis startAxis(const VoxelLattice& lattice, std::uint16_t number, float origin, float direction, int shift) {
  Axis axis;
  if (direction == 0.0F) {
    return axis;
  }
  const int sign = direction > 0.0F ? 1 : -1;
  axis.step = VoxelKey{sign > 0 ? 1U : 0xFFFFU} << shift;
  double border = lattice.center(number);
  border += static_cast<double>(static_cast<float>(sign * lattice.resolutionM() * 0.5));
  axis.t_next = (border - static_cast<double>(origin)) / static_cast<double>(direction);
  axis.t_voxel = lattice.resolutionM() / std::fabs(static_cast<double>(direction));
  return axis;
}

/// Sets bits along a path that mostly stays in one brick.
class PathMarker {
 public:
  PathMarker(VoxelSet& voxels, VoxelKey first) : voxels_(voxels), brick_(brickOf(first)), bits_(&voxels.bits(brick_)) {}

  void mark(VoxelKey key) {
    if (brickOf(key) != brick_) {
      brick_ = brickOf(key);
      bits_ = &voxels_.bits(brick_);
    }
    const unsigned place = placeInBrick(key);
    (*bits_)[place / 64] |= std::uint64_t{1} << (place % 64);
  }

 private:
  VoxelSet& voxels_;
  VoxelKey brick_;
  VoxelSet::Bits* bits_;
};

}  // namespace

double rayLength(const RaySegment& ray) {
  const float x = ray.end.x() - ray.origin.x();
  const float y = ray.end.y() - ray.origin.y();
  const float z = ray.end.z() - ray.origin.z();
  return std::sqrt(static_cast<double>(x * x + y * y + z * z));
}

void markRay(const VoxelLattice& lattice, const RaySegment& ray, VoxelSet& voxels) {
  const auto first = lattice.findKey(ray.origin);
  const auto last = lattice.findKey(ray.end);
  if (!first || !last || *first == *last) {
    return;
  }
  const float length = static_cast<float>(rayLength(ray));
  const auto numbers = unpackVoxelKey(*first);
  const auto axis = [&](int a) {
    return startAxis(lattice, numbers[static_cast<std::size_t>(a)], ray.origin[a], (ray.end[a] - ray.origin[a]) / length,
                     a * kVoxelKeyShift);
  };
  Axis x = axis(0);
  Axis y = axis(1);
  Axis z = axis(2);
  PathMarker marker(voxels, *first);
  VoxelKey key = *first;
  while (true) {
    marker.mark(key);
    Axis& next = x.t_next < y.t_next ? (x.t_next < z.t_next ? x : z) : (y.t_next < z.t_next ? y : z);
    key = (key + next.step) & kVoxelKeyMask;
    next.t_next += next.t_voxel;
    if (key == *last || std::min(std::min(x.t_next, y.t_next), z.t_next) > static_cast<double>(length)) {
      return;
    }
  }
}

}  // namespace oikos::mapping
