// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mapping/volume/brick_index.h"
#include "mapping/volume/occupancy_config.h"
#include "mapping/volume/voxel_key.h"
#include "mapping/volume/voxel_ray.h"
#include "mapping/volume/voxel_set.h"

namespace oikos::mapping {

/// What one camera saw from one place, as OctoMap takes it.
struct OccupancyScan {
  Eigen::Vector3f origin_map = Eigen::Vector3f::Zero();
  std::vector<Eigen::Vector3f> points_map;
};

/// 8×8×8 voxels' log-odds in octree order.
struct OccupancyBrick {
  std::array<float, kBrickVoxels> log_odds{};
  VoxelSet::Bits known{};  ///< voxels that some ray or reading has touched
};

/// Occupancy from scans: after any sequence of `insert`, each voxel is known, and has the log-odds, exactly as after the same
/// sequence of OctoMap 1.9's `OcTree::insertPointCloud(points, origin, max_range, false, true)`: the same ray arithmetic, the
/// same precedence of readings over rays, the same float sums and clamps. Points that are not finite, or whose voxel number does
/// not fit an int, are passed over (OctoMap's result for them is undefined). Memory grows with the voxels known: 4.4 bytes each
/// in full bricks. Not thread-safe; works on `threads` threads inside, with the same bits for any number.
class OccupancyIntegrator {
 public:
  /// Throws ContractViolation when `config.validate()` objects.
  OccupancyIntegrator(const OccupancyConfig& config, int threads);

  void insert(const OccupancyScan& scan);

  [[nodiscard]] const OccupancyConfig& config() const { return config_; }
  [[nodiscard]] const VoxelLattice& lattice() const { return lattice_; }
  [[nodiscard]] std::optional<float> findLogOdds(VoxelKey key) const;
  [[nodiscard]] bool isOccupied(float log_odds) const { return log_odds >= log_odds_threshold_; }
  /// Known voxels in ascending order of bricks.
  void forEachVoxel(const std::function<void(VoxelKey, float)>& visit) const;
  [[nodiscard]] std::size_t memoryBytes() const;

  /// Bricks in ascending order of their keys; for the octree's builder.
  void forEachBrick(const std::function<void(VoxelKey, const OccupancyBrick&)>& visit) const;

 private:
  /// Scratch of one thread.
  struct Worker {
    std::vector<RaySegment> rays;
    VoxelSet free;
    VoxelSet occupied;
  };

  std::vector<VoxelKey> findEndpoints(std::span<const Eigen::Vector3f> points);
  void castRays(const Eigen::Vector3f& origin, std::span<const VoxelKey> endpoints);
  void addRay(const Eigen::Vector3f& origin, VoxelKey endpoint, Worker& worker) const;
  void update();
  void updateBrick(const VoxelSet::Bits& passed, const VoxelSet::Bits& hit, OccupancyBrick& brick) const;
  OccupancyBrick& brickAt(VoxelKey brick);

  OccupancyConfig config_;
  int threads_;
  VoxelLattice lattice_;
  float log_odds_hit_;
  float log_odds_miss_;
  float log_odds_min_;
  float log_odds_max_;
  float log_odds_threshold_;

  BrickIndex index_;
  std::vector<std::unique_ptr<OccupancyBrick>> bricks_;
  std::vector<Worker> workers_;
};

}  // namespace oikos::mapping
