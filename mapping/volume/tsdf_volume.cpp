// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/tsdf_volume.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace oikos::mapping {

namespace {

constexpr float kDistanceUnits = 32000.0F;
constexpr float kWeightAtOneMetre = 32.0F;
constexpr int kAllocationStride_px = 4;  // a brick is many such steps wide at any depth that is used

/// mean + (value - mean)·weight/total, to the nearest integer.
int blend(int mean, int value, int weight, int total) {
  const int change = (value - mean) * weight;
  return mean + (change >= 0 ? change + total / 2 : change - total / 2) / total;
}

struct Reading {
  float distance;  ///< signed, in truncation distances, at most 1
  int weight;
  const std::uint8_t* bgr;
};

void fuse(const Reading& reading, int max_weight, TsdfVoxel& voxel) {
  const int total = voxel.weight + reading.weight;
  const int distance = static_cast<int>(std::lrint(kDistanceUnits * reading.distance));
  voxel.distance = static_cast<std::int16_t>(blend(voxel.distance, distance, reading.weight, total));
  if (reading.distance < 1.0F) {
    const bool has_color = (voxel.rgb_256[0] | voxel.rgb_256[1] | voxel.rgb_256[2]) != 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int value = 256 * reading.bgr[2 - c];
      voxel.rgb_256[c] = static_cast<std::uint16_t>(has_color ? blend(voxel.rgb_256[c], value, reading.weight, total) : value);
    }
  }
  voxel.weight = static_cast<std::uint16_t>(std::min(total, max_weight));
}

/// What the images say about a point in the camera's frame.
class DepthLookup {
 public:
  DepthLookup(const PosedFrame& posed, double truncation_m)
      : depth_(posed.frame.depth_m),
        color_(posed.frame.color),
        fx_(static_cast<float>(posed.camera.fx)),
        fy_(static_cast<float>(posed.camera.fy)),
        cx_(static_cast<float>(posed.camera.cx) + 0.5F),
        cy_(static_cast<float>(posed.camera.cy) + 0.5F),
        per_truncation_(static_cast<float>(1.0 / truncation_m)) {}

  /// Nothing outside the image, without a reading, and where a surface hides the point.
  [[nodiscard]] std::optional<Reading> find(const Eigen::Vector3f& point_camera) const {
    if (point_camera.z() < 0.05F) {
      return std::nullopt;
    }
    const float per_depth = 1.0F / point_camera.z();
    const float u = fx_ * point_camera.x() * per_depth + cx_;
    const float v = fy_ * point_camera.y() * per_depth + cy_;
    if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(depth_.cols) && v < static_cast<float>(depth_.rows))) {
      return std::nullopt;
    }
    const int column = static_cast<int>(u);
    const int row = static_cast<int>(v);
    const float reading_m = depth_.ptr<float>(row)[column];
    const float distance = (reading_m - point_camera.z()) * per_truncation_;
    if (!(distance > -1.0F)) {
      return std::nullopt;
    }
    const float behind = distance < 0.0F ? 1.0F + distance : 1.0F;  // what lies behind a surface is less and less sure
    const float weight = kWeightAtOneMetre * behind / std::max(reading_m * reading_m, 0.25F);
    return Reading{std::min(distance, 1.0F), std::max(1, static_cast<int>(weight)), color_.ptr<std::uint8_t>(row) + 3 * column};
  }

 private:
  const cv::Mat& depth_;
  const cv::Mat& color_;
  float fx_, fy_, cx_, cy_;
  float per_truncation_;
};

}  // namespace

std::vector<std::string> TsdfConfig::validate() const {
  base::ConfigRules rules;
  rules.between("voxel_m", voxel_m, 0.002, 0.2).between("truncation_voxels", truncation_voxels, 2.0, 8.0);
  rules.between("max_weight", max_weight, 1, 32767).between("min_weight", min_weight, 1, max_weight);
  return rules.messages();
}

TsdfVolume::TsdfVolume(const TsdfConfig& config, int threads)
    : config_(config), threads_(threads), lattice_(config.voxel_m), truncation_m_(config.truncation_voxels * config.voxel_m) {
  OIKOS_CHECK(config.validate().empty());
  OIKOS_CHECK(threads >= 1);
}

void TsdfVolume::integrate(const PosedFrame& posed) {
  const cv::Mat& depth = posed.frame.depth_m;
  OIKOS_CHECK(depth.type() == CV_32FC1 && depth.cols == posed.camera.width && depth.rows == posed.camera.height);
  OIKOS_CHECK(posed.frame.color.type() == CV_8UC3 && posed.frame.color.size() == depth.size());
  allocate(posed);
  constexpr int kBlock = 64;
  const int blocks = (static_cast<int>(bricks_.size()) + kBlock - 1) / kBlock;
  base::parallelFor(blocks, threads_, [&](int block) {
    const auto begin = static_cast<std::uint32_t>(block * kBlock);
    const auto end = std::min(begin + kBlock, static_cast<std::uint32_t>(bricks_.size()));
    for (std::uint32_t i = begin; i < end; ++i) {
      if (isInView(index_.key(i), posed)) {
        update(posed, index_.key(i), *bricks_[i]);
      }
    }
  });
}

/// Makes the bricks that the truncation band of some reading passes through.
void TsdfVolume::allocate(const PosedFrame& posed) {
  const cv::Mat& depth = posed.frame.depth_m;
  const Eigen::Isometry3f T_map_camera = posed.T_map_camera.cast<float>();
  const auto truncation = static_cast<float>(truncation_m_);
  for (int v = 0; v < depth.rows; v += kAllocationStride_px) {
    const float* row = depth.ptr<float>(v);
    for (int u = 0; u < depth.cols; u += kAllocationStride_px) {
      if (!(row[u] > truncation)) {
        continue;
      }
      const Eigen::Vector3f ray = posed.camera.ray(u, v).cast<float>();
      for (const float offset : {-truncation, 0.0F, truncation}) {
        const auto key = lattice_.findKey(T_map_camera * ((row[u] + offset) * ray));
        if (key && index_.findOrInsert(brickOf(*key)) == bricks_.size()) {
          bricks_.push_back(std::make_unique<TsdfBrick>());
        }
      }
    }
  }
}

/// Whether some voxel of the brick may project into the image. Cheap and generous; `update` decides voxel by voxel.
bool TsdfVolume::isInView(VoxelKey brick, const PosedFrame& posed) const {
  const double half_m = 0.5 * kBrickSide * config_.voxel_m;
  const double radius_m = std::sqrt(3.0) * half_m;
  const Eigen::Vector3d corner = lattice_.center(brick).cast<double>();
  const Eigen::Vector3d center_map = corner + Eigen::Vector3d::Constant(half_m - 0.5 * config_.voxel_m);
  const Eigen::Vector3d center_camera = posed.T_map_camera.inverse(Eigen::Isometry) * center_map;
  if (center_camera.z() <= 0.0) {
    return false;
  }
  const double margin_px = radius_m / std::max(center_camera.z() - radius_m, 0.05) * std::max(posed.camera.fx, posed.camera.fy);
  return posed.camera.contains(posed.camera.project(center_camera), -margin_px);
}

void TsdfVolume::update(const PosedFrame& posed, VoxelKey key, TsdfBrick& brick) const {
  const Eigen::Isometry3f T_camera_map = posed.T_map_camera.inverse(Eigen::Isometry).cast<float>();
  const Eigen::Vector3f first_camera = T_camera_map * lattice_.center(key);
  const Eigen::Matrix3f step_camera = static_cast<float>(config_.voxel_m) * T_camera_map.linear();
  const DepthLookup lookup(posed, truncation_m_);
  for (int line = 0; line < kBrickSide * kBrickSide; ++line) {
    Eigen::Vector3f point_camera = first_camera + static_cast<float>(line % kBrickSide) * step_camera.col(1) +
                                   static_cast<float>(line / kBrickSide) * step_camera.col(2);
    TsdfVoxel* voxels = &brick.voxels[static_cast<std::size_t>(line * kBrickSide)];
    for (int x = 0; x < kBrickSide; ++x, point_camera += step_camera.col(0)) {
      if (const auto reading = lookup.find(point_camera)) {
        fuse(*reading, config_.max_weight, voxels[x]);
      }
    }
  }
}

}  // namespace oikos::mapping
