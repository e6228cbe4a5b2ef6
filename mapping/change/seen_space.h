// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/change/change_config.h"
#include "mapping/volume/brick_index.h"
#include "mapping/volume/occupancy_integrator.h"
#include "mapping/volume/posed_frame.h"
#include "mapping/volume/voxel_ray.h"
#include "mapping/volume/voxel_set.h"

namespace oikos::mapping {

enum class SpaceState {
  kUnknown,    ///< no ray and no reading ever touched it, or it lies beyond the lattice
  kUncertain,  ///< seen, but neither surely free nor surely occupied
  kFree,       ///< see FreeSpaceConfig; without its neighbours
  kOccupied,
};

/// The map that scans are compared with: occupancy, and beside it from how many views, and whether from views well apart, each voxel was
/// seen free. The frame is `map`, z up. Insert the frames of the mapping drive. About 10 bytes a voxel. Reading is thread-safe, inserting
/// is not.
class SeenSpace {
 public:
  /// Throws ContractViolation when a `validate()` objects.
  SeenSpace(const OccupancyConfig& occupancy, const FreeSpaceConfig& free, int threads);

  /// Costs about as much again as `OccupancyIntegrator::insert`, on one thread.
  void insert(const PosedFrame& posed);

  [[nodiscard]] SpaceState state(VoxelKey key) const;
  [[nodiscard]] const OccupancyIntegrator& occupancy() const { return occupancy_; }
  [[nodiscard]] const VoxelLattice& lattice() const { return occupancy_.lattice(); }
  /// In ascending order of keys.
  [[nodiscard]] std::vector<VoxelKey> occupiedVoxels() const;

 private:
  /// How a voxel was seen free: 5 bytes.
  struct FreeViews {
    std::array<std::int8_t, 3> first_direction{};  ///< to the camera, length 127
    std::uint8_t count = 0;                        ///< stays at 255
    bool apart = false;                            ///< another view from at least the configured angle away
  };
  using Brick = std::array<FreeViews, kBrickVoxels>;

  void countView(const Eigen::Vector3f& origin_map, VoxelKey key);
  [[nodiscard]] bool isSeenFree(VoxelKey key) const;

  FreeSpaceConfig free_;
  OccupancyIntegrator occupancy_;
  float max_free_log_odds_;
  float min_occupied_log_odds_;
  float max_cosine_;
  BrickIndex index_;
  std::vector<std::unique_ptr<Brick>> bricks_;
};

}  // namespace oikos::mapping
