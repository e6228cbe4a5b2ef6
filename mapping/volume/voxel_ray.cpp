// SPDX-License-Identifier: Apache-2.0
//
// Repeats OctoMap's computeRayKeys operation by operation in the same types, so that the voxels are the same to the last ray;
// compiled without contraction of floating-point expressions (set in CMakeLists.txt).
#include "mapping/volume/voxel_ray.h"

#include <limits>
#include <optional>

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

/// Everything about a ray that the traversal needs, or nothing if it passes no voxel.
struct Traversal {
  Axis axes[3];
  VoxelKey first = 0;
  VoxelKey last = 0;
  double length = 0.0;
};

std::optional<Traversal> startTraversal(const VoxelLattice& lattice, const RaySegment& ray) {
  const auto first = lattice.findKey(ray.origin);
  const auto last = lattice.findKey(ray.end);
  if (!first || !last || *first == *last) {
    return std::nullopt;
  }
  const float length = static_cast<float>(rayLength(ray));
  const auto numbers = unpackVoxelKey(*first);
  Traversal traversal{{}, *first, *last, static_cast<double>(length)};
  for (int a = 0; a < 3; ++a) {
    const float direction = (ray.end[a] - ray.origin[a]) / length;
    traversal.axes[a] = startAxis(lattice, numbers[static_cast<std::size_t>(a)], ray.origin[a], direction, a * kVoxelKeyShift);
  }
  return traversal;
}

/// Rays are traversed four at a time in vector registers: which axis is next is a coin toss that a branch would lose.
constexpr int kLanes = 4;
using Doubles = double __attribute__((vector_size(kLanes * sizeof(double))));
using Words = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

class RayBundle {
 public:
  RayBundle(const VoxelLattice& lattice, std::span<const RaySegment> rays, VoxelSet& voxels)
      : lattice_(lattice), rays_(rays), voxels_(voxels) {}

  void markAll() {
    for (int lane = 0; lane < kLanes; ++lane) {
      refill(lane);
    }
    while (live_ > 0) {
      for (int lane = 0; lane < kLanes; ++lane) {
        mark(lane);
      }
      advance();
      if ((done_[0] | done_[1] | done_[2] | done_[3]) != 0) {
        for (int lane = 0; lane < kLanes; ++lane) {
          if (done_[lane] != 0) {
            refill(lane);
          }
        }
      }
    }
  }

 private:
  struct Place {
    VoxelKey brick = ~VoxelKey{0};
    std::uint32_t number = 0;
    bool live = false;
  };

  /// The lane's ray is over: puts the next one in. Without one the lane rests: it never moves, marks nothing, is never done.
  void refill(int lane) {
    Place& place = places_[lane];
    live_ -= place.live ? 1 : 0;
    place.live = false;
    std::optional<Traversal> ray;
    while (!ray && next_ray_ < rays_.size()) {
      ray = startTraversal(lattice_, rays_[next_ray_++]);
    }
    if (ray) {
      place.live = true;
      ++live_;
    } else {
      ray = Traversal{{}, 0, ~VoxelKey{0}, std::numeric_limits<double>::infinity()};
    }
    for (int a = 0; a < 3; ++a) {
      t_next_[a][lane] = ray->axes[a].t_next;
      t_voxel_[a][lane] = ray->axes[a].t_voxel;
      step_[a][lane] = static_cast<std::int64_t>(ray->axes[a].step);
    }
    key_[lane] = static_cast<std::int64_t>(ray->first);
    last_[lane] = static_cast<std::int64_t>(ray->last);
    length_[lane] = ray->length;
    done_[lane] = 0;
  }

  void mark(int lane) {
    const auto key = static_cast<VoxelKey>(key_[lane]);
    Place& place = places_[lane];
    if (brickOf(key) != place.brick) {
      if (!place.live) {
        return;
      }
      place.brick = brickOf(key);
      place.number = voxels_.number(place.brick);
    }
    voxels_.setBit(place.number, placeInBrick(key));
  }

  void advance() {
    const Words x_before_y = t_next_[0] < t_next_[1];
    const Words y_before_z = t_next_[1] < t_next_[2];
    const Words along_x = x_before_y & (t_next_[0] < t_next_[2]);
    const Words along_y = ~x_before_y & y_before_z;
    const Words along_z = ~(along_x | along_y);
    key_ = (key_ + ((step_[0] & along_x) | (step_[1] & along_y) | (step_[2] & along_z))) & static_cast<std::int64_t>(kVoxelKeyMask);
    t_next_[0] += along_x ? t_voxel_[0] : Doubles{};
    t_next_[1] += along_y ? t_voxel_[1] : Doubles{};
    t_next_[2] += along_z ? t_voxel_[2] : Doubles{};
    const Doubles least_xy = t_next_[0] < t_next_[1] ? t_next_[0] : t_next_[1];
    const Doubles least = least_xy < t_next_[2] ? least_xy : t_next_[2];
    done_ = (key_ == last_) | (least > length_);
  }

  const VoxelLattice& lattice_;
  std::span<const RaySegment> rays_;
  VoxelSet& voxels_;
  std::size_t next_ray_ = 0;
  int live_ = 0;
  Place places_[kLanes];
  Doubles t_next_[3] = {};
  Doubles t_voxel_[3] = {};
  Doubles length_ = {};
  Words step_[3] = {};
  Words key_ = {};
  Words last_ = {};
  Words done_ = {};
};

}  // namespace

double rayLength(const RaySegment& ray) {
  const float x = ray.end.x() - ray.origin.x();
  const float y = ray.end.y() - ray.origin.y();
  const float z = ray.end.z() - ray.origin.z();
  return std::sqrt(static_cast<double>(x * x + y * y + z * z));
}

void markRays(const VoxelLattice& lattice, std::span<const RaySegment> rays, VoxelSet& voxels) {
  RayBundle(lattice, rays, voxels).markAll();
}

}  // namespace oikos::mapping
