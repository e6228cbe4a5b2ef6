// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/seen_space.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "mapping/volume/depth_scan.h"

namespace oikos::mapping {

namespace {

float logOdds(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

/// From the camera to each voxel with a reading, or as far as the sensor reaches.
std::vector<RaySegment> raysOf(const OccupancyScan& scan, const VoxelLattice& lattice, double max_range_m) {
  VoxelSet endpoints;
  for (const Eigen::Vector3f& point : scan.points_map) {
    if (const auto key = lattice.findKey(point)) {
      endpoints.insert(*key);
    }
  }
  std::vector<RaySegment> rays;
  endpoints.forEach([&](VoxelKey key) {
    RaySegment ray{scan.origin_map, lattice.center(key)};
    const Eigen::Vector3f along = ray.end - ray.origin;
    if (const double length_m = along.norm(); length_m > max_range_m) {
      ray.end = ray.origin + along * static_cast<float>(max_range_m / length_m);
    }
    rays.push_back(ray);
  });
  return rays;
}

}  // namespace

SeenSpace::SeenSpace(const OccupancyConfig& occupancy, const FreeSpaceConfig& free, int threads)
    : free_(free),
      occupancy_(occupancy, threads),
      max_free_log_odds_(logOdds(free.max_free_probability)),
      min_occupied_log_odds_(logOdds(free.min_occupied_probability)),
      max_cosine_(static_cast<float>(std::cos(free.min_view_angle_rad))) {
  OIKOS_CHECK(free.validate().empty());
}

void SeenSpace::insert(const PosedFrame& posed) {
  const OccupancyScan scan = makeScan(posed, occupancy_.config());
  occupancy_.insert(scan);
  VoxelSet passed;
  markRays(lattice(), raysOf(scan, lattice(), occupancy_.config().max_range_m), passed);
  passed.forEach([&](VoxelKey key) { countView(scan.origin_map, key); });
}

void SeenSpace::countView(const Eigen::Vector3f& origin_map, VoxelKey key) {
  const std::uint32_t number = index_.findOrInsert(brickOf(key));
  if (number == bricks_.size()) {
    bricks_.push_back(std::make_unique<Brick>());
  }
  FreeViews& views = (*bricks_[number])[placeInBrick(key)];
  const Eigen::Vector3f direction = (origin_map - lattice().center(key)).normalized();
  if (views.count == 0) {
    for (int axis = 0; axis < 3; ++axis) {
      views.first_direction[static_cast<std::size_t>(axis)] = static_cast<std::int8_t>(std::lround(127.0F * direction[axis]));
    }
  } else if (!views.apart) {
    const Eigen::Vector3f first(views.first_direction[0], views.first_direction[1], views.first_direction[2]);
    views.apart = first.normalized().dot(direction) <= max_cosine_;
  }
  views.count = static_cast<std::uint8_t>(std::min(255, views.count + 1));
}

bool SeenSpace::isSeenFree(VoxelKey key) const {
  const auto number = index_.find(brickOf(key));
  if (!number) {
    return false;
  }
  const FreeViews& views = (*bricks_[*number])[placeInBrick(key)];
  return views.count >= free_.min_views && (views.apart || free_.min_view_angle_rad == 0.0);
}

SpaceState SeenSpace::state(VoxelKey key) const {
  const auto log_odds = occupancy_.findLogOdds(key);
  if (!log_odds) {
    return SpaceState::kUnknown;
  }
  if (*log_odds >= min_occupied_log_odds_) {
    return SpaceState::kOccupied;
  }
  return *log_odds <= max_free_log_odds_ && isSeenFree(key) ? SpaceState::kFree : SpaceState::kUncertain;
}

std::vector<VoxelKey> SeenSpace::occupiedVoxels() const {
  std::vector<VoxelKey> voxels;
  occupancy_.forEachVoxel([&](VoxelKey key, float log_odds) {
    if (log_odds >= min_occupied_log_odds_) {
      voxels.push_back(key);
    }
  });
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

}  // namespace oikos::mapping
