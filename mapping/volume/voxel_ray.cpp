// SPDX-License-Identifier: Apache-2.0
//
// Repeats OctoMap's computeRayKeys operation by operation in the same types, so that the voxels are the same to the last ray;
// compiled without contraction of floating-point expressions (set in CMakeLists.txt).
#include "mapping/volume/voxel_ray.h"

#include <cstring>
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

/// Lanes are set and read as array elements: GCC 12 miscompiles subscripts of vectors under -fsanitize=undefined.
template <typename Vector, typename Element>
Vector load(const Element (&lanes)[kPairLanes]) {
  Vector vector;
  std::memcpy(&vector, lanes, sizeof(vector));
  return vector;
}
template <typename Vector, typename Element>
void store(const Vector& vector, Element (&lanes)[kPairLanes]) {
  std::memcpy(lanes, &vector, sizeof(vector));
}

struct RayPair {
  double t_next[3][kPairLanes] = {};
  double t_voxel[3][kPairLanes] = {};
  double length[kPairLanes] = {};
  VoxelKey step[3][kPairLanes] = {};
  VoxelKey key[kPairLanes] = {};
  VoxelKey last[kPairLanes] = {};
  std::int64_t done[kPairLanes] = {};  ///< not 0: at its end

  void set(int lane, const Traversal& ray) {
    for (int a = 0; a < 3; ++a) {
      t_next[a][lane] = ray.axes[a].t_next;
      t_voxel[a][lane] = ray.axes[a].t_voxel;
      step[a][lane] = ray.axes[a].step;
    }
    key[lane] = ray.first;
    last[lane] = ray.last;
    length[lane] = ray.length;
  }

  /// To the next voxel.
  void advance() {
    const Doubles x = load<Doubles>(t_next[0]);
    const Doubles y = load<Doubles>(t_next[1]);
    const Doubles z = load<Doubles>(t_next[2]);
    const Words x_before_y = x < y;
    const Words along_x = x_before_y & (x < z);
    const Words along_y = ~x_before_y & (y < z);
    const Words along_z = ~(along_x | along_y);
    const Words steps = (load<Words>(step[0]) & along_x) | (load<Words>(step[1]) & along_y) | (load<Words>(step[2]) & along_z);
    const Words moved = (load<Words>(key) + steps) & static_cast<std::int64_t>(kVoxelKeyMask);
    const Doubles next_x = x + (along_x ? load<Doubles>(t_voxel[0]) : Doubles{});
    const Doubles next_y = y + (along_y ? load<Doubles>(t_voxel[1]) : Doubles{});
    const Doubles next_z = z + (along_z ? load<Doubles>(t_voxel[2]) : Doubles{});
    const Doubles end = load<Doubles>(length);
    const Words beyond = (next_x > end) & (next_y > end) & (next_z > end);
    const Words ended = (moved == load<Words>(last)) | beyond;
    store(moved, key);
    store(next_x, t_next[0]);
    store(next_y, t_next[1]);
    store(next_z, t_next[2]);
    store(ended, done);
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
      pairs_[0].advance();
      pairs_[1].advance();
      if ((pairs_[0].done[0] | pairs_[0].done[1] | pairs_[1].done[0] | pairs_[1].done[1]) != 0) {
        for (int lane = 0; lane < kLanes; ++lane) {
          if (pairs_[lane / kPairLanes].done[lane % kPairLanes] != 0) {
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
    const VoxelKey key = pairs_[lane_number / kPairLanes].key[lane_number % kPairLanes];
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
