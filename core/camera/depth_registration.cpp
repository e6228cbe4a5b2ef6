// SPDX-License-Identifier: Apache-2.0
#include "core/camera/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/error.h"

namespace oikos::camera {

namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothingYet = std::numeric_limits<float>::infinity();

/// A surface seen more frontally by the colour camera than by the depth camera is stretched; room for a slant of about 60 degrees with
/// the few centimetres between the cameras of one sensor.
constexpr double kSlantRoom = 1.1;

float metres(std::uint16_t stored, float unit_m) {
  return stored == 0 || stored == 65535 ? kNoReading : static_cast<float>(stored) * unit_m;
}

/// The colour pixels that the readings of one row cover.
struct SplatRow {
  explicit SplatRow(std::size_t size) : z_m(size), left(size), right(size), top(size), bottom(size) {}
  std::vector<float> z_m;
  std::vector<std::int32_t> left, right, top, bottom;  ///< inclusive and inside the image; left > right or top > bottom: nothing
};

/// One axis of the half-open interval (centre - half, centre + half] as whole pixels; a half of 0.5 gives the nearest pixel and only that.
struct AxisRounder {
  explicit AxisRounder(int size_px, float largest_half_px)
      : last_px(size_px - 1),
        bias_px(static_cast<int>(std::ceil(largest_half_px)) + 3),
        low_px(static_cast<float>(3 - bias_px)),
        high_px(static_cast<float>(size_px + bias_px)) {}
  [[nodiscard]] float clamp(float centre_px) const { return std::min(std::max(centre_px, low_px), high_px); }
  [[nodiscard]] std::int32_t first(float centre_px, float half_px) const {
    return std::max(static_cast<std::int32_t>(centre_px - half_px + static_cast<float>(bias_px + 1)) - bias_px, 0);
  }
  [[nodiscard]] std::int32_t last(float centre_px, float half_px) const {
    return std::min(static_cast<std::int32_t>(centre_px + half_px + static_cast<float>(bias_px)) - bias_px, last_px);
  }
  std::int32_t last_px;
  std::int32_t bias_px;  ///< keeps what is truncated positive
  float low_px;
  float high_px;
};

void paint(const SplatRow& row, cv::Mat& depth_m) {
  for (std::size_t i = 0; i < row.z_m.size(); ++i) {
    for (int v = row.top[i]; v <= row.bottom[i]; ++v) {
      float* pixels = depth_m.ptr<float>(v);
      for (int u = row.left[i]; u <= row.right[i]; ++u) {
        pixels[u] = std::min(pixels[u], row.z_m[i]);
      }
    }
  }
}

}  // namespace

DepthRegistration::DepthRegistration(const Calibration& calibration, const Rectifier& rectifier)
    : color_(calibration.color), stored_(calibration.color), unit_m_(static_cast<float>(1.0 / calibration.depth_scale)) {
  if (calibration.depth) {
    prepareSplatting(*calibration.depth);
  } else {
    source_index_ = rectifier.sourceIndex();
  }
}

void DepthRegistration::prepareSplatting(const DepthCamera& depth) {
  is_separate_ = true;
  stored_ = depth.pinhole;
  Eigen::Matrix3d K_color = Eigen::Matrix3d::Identity();
  K_color << color_.fx, 0.0, color_.cx, 0.0, color_.fy, color_.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d homography = K_color * depth.T_color_depth.linear();
  const Eigen::Vector3d offset = K_color * depth.T_color_depth.translation();
  offset_u_ = static_cast<float>(offset.x());
  offset_v_ = static_cast<float>(offset.y());
  offset_z_ = static_cast<float>(offset.z());
  double widest_px = 1.0;
  double highest_px = 1.0;
  for (int v = 0; v < stored_.height; ++v) {
    for (int u = 0; u < stored_.width; ++u) {
      const Eigen::Vector3d ray = homography * stored_.ray(u, v);
      ray_u_.push_back(static_cast<float>(ray.x()));
      ray_v_.push_back(static_cast<float>(ray.y()));
      ray_z_.push_back(static_cast<float>(ray.z()));
      if (ray.z() > 0.0 && color_.contains(ray.head<2>() / ray.z())) {
        const Eigen::Vector2d right = (homography * stored_.ray(u + 1, v)).hnormalized() - ray.hnormalized();
        const Eigen::Vector2d below = (homography * stored_.ray(u, v + 1)).hnormalized() - ray.hnormalized();
        widest_px = std::max(widest_px, kSlantRoom * (std::abs(right.x()) + std::abs(below.x())));
        highest_px = std::max(highest_px, kSlantRoom * (std::abs(right.y()) + std::abs(below.y())));
      }
    }
  }
  half_width_px_ = static_cast<float>(0.5 * widest_px);
  half_height_px_ = static_cast<float>(0.5 * highest_px);
}

cv::Mat DepthRegistration::toMetres(const cv::Mat& stored) const {
  OIKOS_CHECK(stored.type() == CV_16UC1 && stored.cols == stored_.width && stored.rows == stored_.height);
  return is_separate_ ? splat(stored) : convert(stored);
}

cv::Mat DepthRegistration::convert(const cv::Mat& stored) const {
  cv::Mat depth_m(color_.height, color_.width, CV_32FC1);
  OIKOS_CHECK(stored.isContinuous() && depth_m.isContinuous());
  const auto* from = stored.ptr<std::uint16_t>();
  auto* to = depth_m.ptr<float>();
  const std::size_t count = depth_m.total();
  if (source_index_.empty()) {
    for (std::size_t i = 0; i < count; ++i) {
      to[i] = metres(from[i], unit_m_);
    }
    return depth_m;
  }
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = source_index_[i] < 0 ? kNoReading : metres(from[source_index_[i]], unit_m_);
  }
  return depth_m;
}

cv::Mat DepthRegistration::splat(const cv::Mat& stored) const {
  constexpr float kNearest_m = 0.01F;
  constexpr float kLargestGrowth = 4.0F;  // of a splat whose reading is much nearer to the colour camera than to the depth camera
  cv::Mat depth_m(color_.height, color_.width, CV_32FC1, cv::Scalar(kNothingYet));
  const AxisRounder across(color_.width, half_width_px_ * kLargestGrowth);
  const AxisRounder down(color_.height, half_height_px_ * kLargestGrowth);
  const auto width = static_cast<std::size_t>(stored_.width);
  SplatRow row(width);
  for (int v = 0; v < stored_.height; ++v) {
    const auto* readings = stored.ptr<std::uint16_t>(v);
    const float* ray_u = &ray_u_[static_cast<std::size_t>(v) * width];
    const float* ray_v = &ray_v_[static_cast<std::size_t>(v) * width];
    const float* ray_z = &ray_z_[static_cast<std::size_t>(v) * width];
    for (std::size_t i = 0; i < width; ++i) {
      const float reading_m = static_cast<float>(readings[i]) * unit_m_;
      const float z_m = ray_z[i] * reading_m + offset_z_;
      const float inverse_z = 1.0F / std::max(z_m, kNearest_m);
      const float growth = std::min(reading_m * inverse_z, kLargestGrowth);
      const float half_width = std::max(0.5F, half_width_px_ * growth);
      const float half_height = std::max(0.5F, half_height_px_ * growth);
      const float u_px = across.clamp((ray_u[i] * reading_m + offset_u_) * inverse_z);
      const float v_px = down.clamp((ray_v[i] * reading_m + offset_v_) * inverse_z);
      const bool valid = readings[i] != 0 && readings[i] != 65535 && z_m > kNearest_m;
      row.z_m[i] = z_m;
      row.left[i] = across.first(u_px, half_width);
      row.right[i] = across.last(u_px, half_width);
      row.top[i] = down.first(v_px, half_height);
      row.bottom[i] = valid ? down.last(v_px, half_height) : -1;
    }
    paint(row, depth_m);
  }
  depth_m.setTo(kNoReading, depth_m == kNothingYet);
  return depth_m;
}

}  // namespace oikos::camera
