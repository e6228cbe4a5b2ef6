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

/// Rays are traversed in vector registers, two to a register: which axis is next is a coin toss that a branch would lose.
constexpr int kPairLanes = 2;
using Doubles = double __attribute__((vector_size(kPairLanes * sizeof(double))));
using Words = std::int64_t __attribute__((vector_size(kPairLanes * sizeof(std::int64_t))));

struct RayPair {
  Doubles t_next[3] = {};
  Doubles t_voxel[3] = {};
  Doubles length = {};
  Words step[3] = {};
  Words key = {};
  Words last = {};

  void set(int lane, const Traversal& ray) {
    for (int a = 0; a < 3; ++a) {
      t_next[a][lane] = ray.axes[a].t_next;
      t_voxel[a][lane] = ray.axes[a].t_voxel;
      step[a][lane] = static_cast<std::int64_t>(ray.axes[a].step);
    }
    key[lane] = static_cast<std::int64_t>(ray.first);
    last[lane] = static_cast<std::int64_t>(ray.last);
    length[lane] = ray.length;
  }

  /// To the next voxel; the lanes that are at their end then are not zero in the result.
  Words advance() {
    const Words x_before_y = t_next[0] < t_next[1];
    const Words along_x = x_before_y & (t_next[0] < t_next[2]);
    const Words along_y = ~x_before_y & (t_next[1] < t_next[2]);
    const Words along_z = ~(along_x | along_y);
    key = (key + ((step[0] & along_x) | (step[1] & along_y) | (step[2] & along_z))) & static_cast<std::int64_t>(kVoxelKeyMask);
    t_next[0] += along_x ? t_voxel[0] : Doubles{};
    t_next[1] += along_y ? t_voxel[1] : Doubles{};
    t_next[2] += along_z ? t_voxel[2] : Doubles{};
    const Words beyond = (t_next[0] > length) & (t_next[1] > length) & (t_next[2] > length);
    return (key == last) | beyond;
  }
};

/// Four rays under way at a time, each lane with its own share of the rays: neighbouring rays would wait for one another's bits.
class RayBundle {
 public:
  RayBundle(const VoxelLattice& lattice, std::span<const RaySegment> rays, VoxelSet& voxels)
      : lattice_(lattice), rays_(rays), voxels_(voxels) {}

  void markAll() {
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes_[lane].next_ray = rays_.size() * static_cast<std::size_t>(lane) / kLanes;
      lanes_[lane].end_ray = rays_.size() * static_cast<std::size_t>(lane + 1) / kLanes;
      refill(lane);
    }
    while (live_ > 0) {
      for (int lane = 0; lane < kLanes; ++lane) {
        mark(lane);
      }
      const Words done_low = pairs_[0].advance();
      const Words done_high = pairs_[1].advance();
      const Words any = done_low | done_high;
      if ((any[0] | any[1]) != 0) {
        for (int lane = 0; lane < kLanes; ++lane) {
          if ((lane < kPairLanes ? done_low : done_high)[lane % kPairLanes] != 0) {
            refill(lane);
          }
        }
      }
    }
  }

 private:
  static constexpr int kLanes = 2 * kPairLanes;

  struct Lane {
    std::size_t next_ray = 0;
    std::size_t end_ray = 0;
    VoxelKey brick = ~VoxelKey{0};
    std::uint32_t number = 0;
    bool live = false;
  };

  /// The lane's ray is over: puts the next one in. Without one the lane rests: it never moves, marks nothing, is never done.
  void refill(int lane_number) {
    Lane& lane = lanes_[lane_number];
    live_ -= lane.live ? 1 : 0;
    std::optional<Traversal> ray;
    while (!ray && lane.next_ray < lane.end_ray) {
      ray = startTraversal(lattice_, rays_[lane.next_ray++]);
    }
    lane.live = ray.has_value();
    live_ += lane.live ? 1 : 0;
    const Traversal rest{{}, 0, ~VoxelKey{0}, std::numeric_limits<double>::infinity()};
    pairs_[lane_number / kPairLanes].set(lane_number % kPairLanes, ray.value_or(rest));
  }

  void mark(int lane_number) {
    const auto key = static_cast<VoxelKey>(pairs_[lane_number / kPairLanes].key[lane_number % kPairLanes]);
    Lane& lane = lanes_[lane_number];
    if (brickOf(key) != lane.brick) {
      if (!lane.live) {
        return;
      }
      lane.brick = brickOf(key);
      lane.number = voxels_.number(lane.brick);
    }
    if (lane.live) {
      voxels_.setBit(lane.number, placeInBrick(key));
    }
  }

  const VoxelLattice& lattice_;
  std::span<const RaySegment> rays_;
  VoxelSet& voxels_;
  int live_ = 0;
  Lane lanes_[kLanes];
  RayPair pairs_[2];
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
