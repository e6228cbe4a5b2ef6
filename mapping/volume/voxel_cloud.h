// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "mapping/volume/brick_index.h"
#include "mapping/volume/posed_frame.h"
#include "mapping/volume/voxel_ray.h"

namespace oikos::mapping {

struct VoxelCloudConfig {
  double voxel_m = 0.01;  ///< one point a voxel
  int pixel_stride = 2;   ///< every n-th pixel of every n-th row
  int min_readings = 2;   ///< voxels with fewer are left out

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("voxel_m", voxel_m);
    visitor("pixel_stride", pixel_stride);
    visitor("min_readings", min_readings);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// A coloured cloud as it grows: per voxel the centroid of position and colour, summed in integers (positions to 1/256 of a
/// voxel), so that the order of the readings does not matter until a voxel has had 65535, after which it takes no more. About
/// 25 bytes a voxel. Points farther than 32767 voxels from the origin are left out. Not thread-safe.
class VoxelCloud {
 public:
  explicit VoxelCloud(const VoxelCloudConfig& config);

  void add(const PosedFrame& posed);

  [[nodiscard]] std::size_t pointCount() const;
  /// In ascending order of voxels, whatever the order of the frames.
  void forEachPoint(const std::function<void(const Eigen::Vector3f& point_map, const geometry::Rgb& color)>& visit) const;
  /// Binary PLY; atomic, throws Error{kIo}.
  void write(const std::filesystem::path& file) const;
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  /// Sums of x, y, z within the voxel and of red, green, blue: 24 bits each.
  struct Entry {
    std::array<std::uint16_t, 6> low{};
    std::array<std::uint8_t, 6> high{};
    std::uint16_t count = 0;
  };
  /// 4×4×4 voxels; those with readings lie in `entries` in the order of their bits.
  struct Brick {
    std::uint64_t occupied = 0;
    std::vector<Entry> entries;
  };

  void addPoint(const Eigen::Vector3f& point_map, const std::uint8_t* bgr);
  Entry& entryAt(VoxelKey key);

  VoxelCloudConfig config_;
  VoxelLattice lattice_;
  BrickIndex index_;
  std::vector<Brick> bricks_;
  VoxelKey latest_key_ = ~VoxelKey{0};
  std::uint32_t latest_number_ = 0;
};

}  // namespace oikos::mapping
