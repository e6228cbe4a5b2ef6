// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mapping/volume/brick_index.h"
#include "mapping/volume/posed_frame.h"
#include "mapping/volume/voxel_ray.h"

namespace oikos::mapping {

struct TsdfConfig {
  double voxel_m = 0.02;
  double truncation_voxels = 4.0;  ///< distances are kept up to this far from a surface; must exceed the depth's noise
  int max_weight = 4096;           ///< a reading at 1 m weighs 32, at 2 m 8; above this sum the newest keep their say
  int min_weight = 6;              ///< voxels seen with less make no surface

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("voxel_m", voxel_m);
    visitor("truncation_voxels", truncation_voxels);
    visitor("max_weight", max_weight);
    visitor("min_weight", min_weight);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Signed distance to the surface along the viewing direction, positive in free space, and colour; running means in fixed point.
struct TsdfVoxel {
  std::int16_t distance = 0;               ///< in 1/32000 of the truncation distance
  std::uint16_t weight = 0;                ///< 0: never seen
  std::array<std::uint16_t, 3> rgb_256{};  ///< 256ths; all 0: no colour yet
};

/// 8×8×8 voxels, x fastest.
struct TsdfBrick {
  std::array<TsdfVoxel, kBrickVoxels> voxels{};
  static constexpr int place(int x, int y, int z) { return x + kBrickSide * (y + kBrickSide * z); }
};

/// Coloured truncated signed distance function in bricks around the surfaces (Curless & Levoy, "A Volumetric Method for Building
/// Complex Models from Range Images", SIGGRAPH 1996; bricks as in Nießner et al., TOG 2013). A reading's weight falls with the
/// square of its depth, as the standard deviation of triangulated depth grows with it. About 5 KB a brick. Not thread-safe; works
/// on `threads` threads inside, with the same bits for any number.
class TsdfVolume {
 public:
  TsdfVolume(const TsdfConfig& config, int threads);

  /// Frames' order matters to the last bit (running means): fuse them in keyframe order.
  void integrate(const PosedFrame& posed);

  [[nodiscard]] const TsdfConfig& config() const { return config_; }
  [[nodiscard]] const VoxelLattice& lattice() const { return lattice_; }
  [[nodiscard]] const BrickIndex& index() const { return index_; }
  [[nodiscard]] const TsdfBrick* find(VoxelKey brick) const {
    const auto number = index_.find(brick);
    return number ? bricks_[*number].get() : nullptr;
  }
  [[nodiscard]] std::size_t memoryBytes() const { return index_.memoryBytes() + bricks_.size() * (sizeof(TsdfBrick) + 24); }

 private:
  void allocate(const PosedFrame& posed);
  [[nodiscard]] bool isInView(VoxelKey brick, const PosedFrame& posed) const;
  void update(const PosedFrame& posed, VoxelKey key, TsdfBrick& brick) const;

  TsdfConfig config_;
  int threads_;
  VoxelLattice lattice_;
  double truncation_m_;
  BrickIndex index_;
  std::vector<std::unique_ptr<TsdfBrick>> bricks_;
};

}  // namespace oikos::mapping
