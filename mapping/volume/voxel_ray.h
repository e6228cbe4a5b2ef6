// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <span>

#include "mapping/volume/voxel_key.h"
#include "mapping/volume/voxel_set.h"

namespace oikos::mapping {

/// Voxels against coordinates with OctoMap's arithmetic (OcTreeBaseImpl: coordToKey, coordToKeyChecked, keyToCoord).
class VoxelLattice {
 public:
  explicit VoxelLattice(double resolution_m) : resolution_m_(resolution_m), voxels_per_m_(1.0 / resolution_m) {}

  [[nodiscard]] double resolutionM() const { return resolution_m_; }

  /// Whether the point's voxel numbers are numbers at all: finite, and small enough for an int.
  [[nodiscard]] bool hasNumber(const Eigen::Vector3f& point) const {
    constexpr double kLimit = 2147418112.0;  // 2^31 less twice the lattice's own offset
    return std::abs(voxels_per_m_ * static_cast<double>(point.x())) < kLimit &&
           std::abs(voxels_per_m_ * static_cast<double>(point.y())) < kLimit &&
           std::abs(voxels_per_m_ * static_cast<double>(point.z())) < kLimit;
  }
  /// The point's voxel; beyond the lattice it comes back in at the other side. `hasNumber(point)` must hold.
  [[nodiscard]] VoxelKey wrappedKey(const Eigen::Vector3f& point) const {
    return packVoxelKey(static_cast<std::uint16_t>(number(point.x())), static_cast<std::uint16_t>(number(point.y())),
                        static_cast<std::uint16_t>(number(point.z())));
  }
  /// The point's voxel, if the lattice reaches there.
  [[nodiscard]] std::optional<VoxelKey> findKey(const Eigen::Vector3f& point) const {
    if (!hasNumber(point)) {
      return std::nullopt;
    }
    const int x = number(point.x());
    const int y = number(point.y());
    const int z = number(point.z());
    if (((x | y | z) & ~0xFFFF) != 0) {
      return std::nullopt;
    }
    return packVoxelKey(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(z));
  }
  [[nodiscard]] double center(std::uint16_t number) const { return (double(number - kVoxelKeyOrigin) + 0.5) * resolution_m_; }
  [[nodiscard]] Eigen::Vector3f center(VoxelKey key) const {
    const auto xyz = unpackVoxelKey(key);
    return {static_cast<float>(center(xyz[0])), static_cast<float>(center(xyz[1])), static_cast<float>(center(xyz[2]))};
  }

 private:
  [[nodiscard]] int number(float coordinate_m) const {
    // floor(); the library's is a call on machines without SSE4.1
    const double voxels = voxels_per_m_ * static_cast<double>(coordinate_m);
    const int truncated = static_cast<int>(voxels);
    return truncated - (voxels < static_cast<double>(truncated) ? 1 : 0) + kVoxelKeyOrigin;
  }

  double resolution_m_;
  double voxels_per_m_;
};

struct RaySegment {
  Eigen::Vector3f origin;
  Eigen::Vector3f end;
};

/// Euclidean length as OctoMap's Vector3::norm has it: squares summed in float, the root taken in double.
[[nodiscard]] double rayLength(const RaySegment& ray);

/// For each ray, adds the voxels from the origin's up to, without, the end's. A ray adds none when both are one voxel, or when
/// either lies beyond the lattice. (Amanatides & Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987; OctoMap's
/// computeRayKeys.)
void markRays(const VoxelLattice& lattice, std::span<const RaySegment> rays, VoxelSet& voxels);

}  // namespace oikos::mapping
