// SPDX-License-Identifier: Apache-2.0
#include "core/camera/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/error.h"

namespace oikos::camera {

/// Where the readings of one row appear in the colour camera; those that do not are far outside the image.
struct DepthRegistration::ProjectedRow {
  explicit ProjectedRow(std::size_t size) : reading_m(size), z_m(size), u_px(size), v_px(size) {}
  std::vector<float> reading_m;  ///< distance to the depth camera
  std::vector<float> z_m;        ///< distance to the colour camera
  std::vector<float> u_px, v_px;
};

namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothingYet = std::numeric_limits<float>::infinity();

constexpr float kNearest_m = 0.01F;
constexpr float kLargestGrowth = 4.0F;  // of a splat, where a reading is nearer to the colour camera than to the depth camera

/// A surface seen more frontally by the colour camera than by the depth camera is stretched; room for a slant of about 60 degrees with
/// the few centimetres between the cameras of one sensor.
constexpr double kSlantRoom = 1.1;

float metres(std::uint16_t stored, float unit_m) {
  return stored == 0 || stored == 65535 ? kNoReading : static_cast<float>(stored) * unit_m;
}

constexpr float kNowhere_px = -1e6F;

/// Nearest whole pixel; a negative number for everything left of the image, far outside included.
int roundPixel(float pixel) {
  return static_cast<int>(pixel + 1.5F) - 1;
}

template <typename Row>
void paintNearest(const Row& row, cv::Mat& depth_m) {
  const auto width = static_cast<unsigned>(depth_m.cols);
  const auto height = static_cast<unsigned>(depth_m.rows);
  auto* pixels = depth_m.ptr<float>();
  for (std::size_t i = 0; i < row.z_m.size(); ++i) {
    const auto u = static_cast<unsigned>(roundPixel(row.u_px[i]));
    const auto v = static_cast<unsigned>(roundPixel(row.v_px[i]));
    if (u < width && v < height) {
      float& pixel = pixels[v * width + u];
      pixel = std::min(pixel, row.z_m[i]);
    }
  }
}

/// Whole pixels of the half-open interval (centre - half, centre + half], clipped to the image.
struct Span {
  Span(float centre_px, float half_px, int size_px)
      : first(std::max(static_cast<int>(std::floor(centre_px - half_px)) + 1, 0)),
        last(std::min(static_cast<int>(std::floor(centre_px + half_px)), size_px - 1)) {}
  int first;
  int last;
};

template <typename Row>
void paintFootprints(const Row& row, const cv::Size2f& half_px, cv::Mat& depth_m) {
  for (std::size_t i = 0; i < row.z_m.size(); ++i) {
    const float growth = std::min(row.reading_m[i] / std::max(row.z_m[i], kNearest_m), kLargestGrowth);
    const Span across(row.u_px[i], std::max(0.5F, half_px.width * growth), depth_m.cols);
    const Span down(row.v_px[i], std::max(0.5F, half_px.height * growth), depth_m.rows);
    for (int v = down.first; v <= down.last; ++v) {
      auto* pixels = depth_m.ptr<float>(v);
      for (int u = across.first; u <= across.last; ++u) {
        pixels[u] = std::min(pixels[u], row.z_m[i]);
      }
    }
  }
}

void liftReadings(const std::uint16_t* __restrict readings, float unit_m, std::size_t count, float* __restrict reading_m) {
  for (std::size_t i = 0; i < count; ++i) {
    const int reading = readings[i] == 65535 ? 0 : readings[i];
    reading_m[i] = static_cast<float>(reading) * unit_m;
  }
}

void correctReadings(const float* __restrict factor, float factor_per_m, std::size_t count, float* __restrict reading_m) {
  for (std::size_t i = 0; i < count; ++i) {
    reading_m[i] *= factor[i] + factor_per_m * reading_m[i];
  }
}

float clampPixel(float pixel) {
  const float not_left = pixel > kNowhere_px ? pixel : kNowhere_px;
  return not_left < -kNowhere_px ? not_left : -kNowhere_px;
}

void markUnseen(cv::Mat& depth_m) {
  auto* pixels = depth_m.ptr<float>();
  const std::size_t count = depth_m.total();
  for (std::size_t i = 0; i < count; ++i) {
    pixels[i] = pixels[i] < kNothingYet ? pixels[i] : kNoReading;
  }
}

}  // namespace

DepthRegistration::DepthRegistration(const Calibration& calibration, const Rectifier& rectifier)
    : color_(calibration.color), stored_(calibration.color), unit_m_(static_cast<float>(1.0 / calibration.depth_scale)) {
  if (calibration.depth) {
    prepareSplatting(*calibration.depth);
    prepareCorrection(*calibration.depth);
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
  offset_ = (K_color * depth.T_color_depth.translation()).cast<float>();
  Eigen::Vector2d largest_px = Eigen::Vector2d::Zero();
  double largest_growth = 1.0;
  for (int v = 0; v < stored_.height; ++v) {
    for (int u = 0; u < stored_.width; ++u) {
      const Eigen::Vector3d ray = homography * stored_.ray(u, v);
      ray_u_.push_back(static_cast<float>(ray.x()));
      ray_v_.push_back(static_cast<float>(ray.y()));
      ray_z_.push_back(static_cast<float>(ray.z()));
      if (ray.z() > 0.0 && color_.contains(ray.head<2>() / ray.z())) {
        const Eigen::Vector2d right = (homography * stored_.ray(u + 1, v)).hnormalized() - ray.hnormalized();
        const Eigen::Vector2d below = (homography * stored_.ray(u, v + 1)).hnormalized() - ray.hnormalized();
        largest_px = largest_px.cwiseMax((right.cwiseAbs() + below.cwiseAbs()) * ray.z());
        largest_growth = std::max(largest_growth, 1.0 / ray.z());
      }
    }
  }
  const Eigen::Vector2f half_px = (0.5 * kSlantRoom * largest_px).cast<float>();
  half_splat_px_ = {half_px.x(), half_px.y()};
  is_single_pixel_ = offset_.z() >= 0.0F && half_px.maxCoeff() * static_cast<float>(largest_growth) <= 0.5F;
}

void DepthRegistration::prepareCorrection(const DepthCamera& depth) {
  if (depth.correction.isZero()) {
    return;
  }
  factor_per_m_ = static_cast<float>(depth.correction.per_m);
  for (int v = 0; v < stored_.height; ++v) {
    for (int u = 0; u < stored_.width; ++u) {
      const Eigen::Vector3d ray = stored_.ray(u, v);
      factor_.push_back(
          static_cast<float>(1.0 + depth.correction.constant + depth.correction.across * ray.x() + depth.correction.down * ray.y()));
    }
  }
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

void DepthRegistration::project(const cv::Mat& stored, int v, ProjectedRow& row) const {
  const std::size_t first = static_cast<std::size_t>(v) * static_cast<std::size_t>(stored_.width);
  const std::size_t count = row.z_m.size();
  liftReadings(stored.ptr<std::uint16_t>(v), unit_m_, count, row.reading_m.data());
  if (!factor_.empty()) {
    correctReadings(&factor_[first], factor_per_m_, count, row.reading_m.data());
  }
  const float* __restrict reading_m = row.reading_m.data();
  const float* __restrict ray_u = &ray_u_[first];
  const float* __restrict ray_v = &ray_v_[first];
  const float* __restrict ray_z = &ray_z_[first];
  float* __restrict z_m = row.z_m.data();
  float* __restrict u_px = row.u_px.data();
  float* __restrict v_px = row.v_px.data();
  const Eigen::Array3f offset = offset_;
  const float offset_u = offset[0];
  const float offset_v = offset[1];
  const float offset_z = offset[2];
  for (std::size_t i = 0; i < count; ++i) {
    const float z = ray_z[i] * reading_m[i] + offset_z;
    const float inverse_z = 1.0F / (z > kNearest_m ? z : kNearest_m);
    const float u = (ray_u[i] * reading_m[i] + offset_u) * inverse_z;
    const float w = (ray_v[i] * reading_m[i] + offset_v) * inverse_z;
    // added, not chosen by a branch, so that the compiler can vectorise
    const float away_if_none = reading_m[i] > 0.0F ? 0.0F : 3.0F * kNowhere_px;
    const float away_if_behind = z > kNearest_m ? 0.0F : 3.0F * kNowhere_px;
    z_m[i] = z;
    u_px[i] = clampPixel(u) + away_if_none + away_if_behind;
    v_px[i] = clampPixel(w);
  }
}

cv::Mat DepthRegistration::splat(const cv::Mat& stored) const {
  cv::Mat depth_m(color_.height, color_.width, CV_32FC1, cv::Scalar(kNothingYet));
  ProjectedRow row(static_cast<std::size_t>(stored_.width));
  for (int v = 0; v < stored_.height; ++v) {
    project(stored, v, row);
    if (is_single_pixel_) {
      paintNearest(row, depth_m);
    } else {
      paintFootprints(row, half_splat_px_, depth_m);
    }
  }
  markUnseen(depth_m);
  return depth_m;
}

}  // namespace oikos::camera
