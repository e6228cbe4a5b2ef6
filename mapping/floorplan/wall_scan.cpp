// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/wall_scan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "mapping/volume/depth_normal.h"

namespace oikos::mapping {

namespace {

constexpr double kUprightCosine = 0.26;  ///< 15°: how far a wall's normal may lean
constexpr double kLevelCosine = 0.94;    ///< 20°: and a floor's
constexpr double kHeightBin_m = 0.2;
constexpr int kMinReadings = 3;
constexpr int kDirections = 8;  ///< surfaces of one cell that face so differently are kept apart
constexpr std::int64_t kHalfGrid = 1 << 20;

std::uint64_t cellKey(const Eigen::Vector2d& point, double cell_m) {
  const auto index = [&](double x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell_m)) + kHalfGrid); };
  return (index(point.x()) << 24U) | (index(point.y()) << 3U);
}

Eigen::Vector2d cellCorner(std::uint64_t key, double cell_m) {
  const auto coordinate = [&](std::uint64_t index) { return static_cast<double>(static_cast<std::int64_t>(index) - kHalfGrid) * cell_m; };
  return {coordinate(key >> 24U), coordinate((key >> 3U) & 0x1FFFFFU)};
}

std::uint64_t directionOf(const Eigen::Vector3d& normal) {
  const double turn = (std::atan2(normal.y(), normal.x()) / (2.0 * std::numbers::pi) + 1.0) * kDirections;
  return static_cast<std::uint64_t>(std::lround(turn)) % kDirections;
}

}  // namespace

std::vector<std::string> WallScanConfig::validate() const {
  base::ConfigRules rules;
  rules.between("cell_m", cell_m, 0.01, 0.2).between("pixel_stride", pixel_stride, 1, 64);
  rules.between("normal_baseline_m", normal_baseline_m, 0.01, 1.0).greater("max_range_m", max_range_m, 0.0);
  rules.between("min_height_m", min_height_m, 0.1, 2.0).between("max_height_m", max_height_m, 0.2, 6.0);
  rules.require(max_height_m > min_height_m, "max_height_m", max_height_m, "must be > min_height_m");
  rules.between("min_height_bins", min_height_bins, 1, 30).between("floor_band_m", floor_band_m, 0.0, 0.2);
  rules.atLeast("max_views", max_views, 1);
  return rules.messages();
}

WallScan::WallScan(const WallScanConfig& config) : config_(config) {
  OIKOS_CHECK(config.validate().empty());
}

void WallScan::add(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_level_camera) {
  OIKOS_CHECK(depth_m.type() == CV_32FC1 && depth_m.cols == camera.width && depth_m.rows == camera.height);
  for (int v = 0; v < depth_m.rows; v += config_.pixel_stride) {
    for (int u = 0; u < depth_m.cols; u += config_.pixel_stride) {
      const double z = static_cast<double>(depth_m.ptr<float>(v)[u]);
      const double wanted_px = 0.5 * config_.normal_baseline_m * camera.fx / z;
      const int room_px = std::min({u, v, depth_m.cols - 1 - u, depth_m.rows - 1 - v});
      if (!(z > 0.0) || z > config_.max_range_m || !(wanted_px <= room_px)) {
        continue;
      }
      const auto normal = findDepthNormal(depth_m, camera, {u, v}, std::max(2, static_cast<int>(wanted_px)));
      if (!normal) {
        continue;
      }
      const Eigen::Vector3d point_level = T_level_camera * (z * camera.ray(u, v));
      const Eigen::Vector3d normal_level = T_level_camera.linear() * normal->cast<double>();
      if (std::abs(normal_level.z()) < kUprightCosine && point_level.z() >= config_.min_height_m &&
          point_level.z() < config_.max_height_m) {
        addWall(point_level, normal_level, std::min(1.0, 1.0 / (z * z * z * z)));
      } else if (normal_level.z() > kLevelCosine && std::abs(point_level.z()) < config_.floor_band_m) {
        addFloor(point_level);
      }
    }
  }
}

void WallScan::addWall(const Eigen::Vector3d& point_level, const Eigen::Vector3d& normal_level, double weight) {
  const std::uint64_t key = cellKey(point_level.head<2>(), config_.cell_m) | directionOf(normal_level);
  const std::uint32_t number = wall_index_.findOrInsert(key);
  if (number == walls_.size()) {
    walls_.emplace_back();
  }
  Sum& sum = walls_[number];
  sum.point += weight * (point_level.head<2>() - cellCorner(key, config_.cell_m));
  sum.normal += weight * normal_level.head<2>().normalized();
  sum.weight += weight;
  ++sum.count;
  const auto bin = static_cast<unsigned>((point_level.z() - config_.min_height_m) / kHeightBin_m);
  sum.heights |= 1U << std::min(bin, 31U);
}

void WallScan::addFloor(const Eigen::Vector3d& point_level) {
  const std::uint32_t number = floor_index_.findOrInsert(cellKey(point_level.head<2>(), config_.cell_m));
  if (number == floor_counts_.size()) {
    floor_counts_.push_back(0);
  }
  ++floor_counts_[number];
}

WallSketch WallScan::sketch() const {
  WallSketch sketch;
  sketch.cell_m = config_.cell_m;
  for (const std::uint32_t number : wall_index_.sorted()) {
    const Sum& sum = walls_[number];
    if (sum.count >= kMinReadings && std::popcount(sum.heights) >= config_.min_height_bins && sum.normal.norm() > 0.5 * sum.weight) {
      sketch.walls.push_back({cellCorner(wall_index_.key(number), config_.cell_m) + sum.point / sum.weight, sum.normal.normalized()});
    }
  }
  for (const std::uint32_t number : floor_index_.sorted()) {
    if (floor_counts_[number] >= kMinReadings) {
      sketch.floor_level.push_back(cellCorner(floor_index_.key(number), config_.cell_m) + Eigen::Vector2d::Constant(0.5 * config_.cell_m));
    }
  }
  return sketch;
}

}  // namespace oikos::mapping
