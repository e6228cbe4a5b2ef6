// SPDX-License-Identifier: Apache-2.0
#include "core/camera/rectifier.h"

#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"

namespace oikos::camera {

namespace {

constexpr float kOutside_px = -16.0F;  // far enough out that bilinear interpolation mixes in nothing of the image

}  // namespace

Eigen::Vector2d LensDistortion::distort(const Eigen::Vector2d& undistorted) const {
  const double x = undistorted.x();
  const double y = undistorted.y();
  const double r_sq = x * x + y * y;
  const double radial = 1.0 + r_sq * (k1 + r_sq * (k2 + r_sq * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r_sq + 2.0 * x * x), y * radial + p1 * (r_sq + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Rectifier::Rectifier(const PinholeCamera& camera, const LensDistortion& distortion) {
  if (distortion.isZero()) {
    return;
  }
  cv::Mat map_px(camera.height, camera.width, CV_32FC2);
  source_index_.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d stored = distortion.distort(camera.ray(u, v).head<2>());
      const Eigen::Vector2d stored_px(camera.fx * stored.x() + camera.cx, camera.fy * stored.y() + camera.cy);
      const bool inside = camera.contains(stored_px);
      map_px.at<cv::Vec2f>(v, u) =
          inside ? cv::Vec2f(static_cast<float>(stored_px.x()), static_cast<float>(stored_px.y())) : cv::Vec2f(kOutside_px, kOutside_px);
      source_index_.push_back(inside ? static_cast<std::int32_t>(std::lround(stored_px.y()) * camera.width + std::lround(stored_px.x()))
                                     : -1);
    }
  }
  cv::convertMaps(map_px, cv::noArray(), map_px_, map_fraction_, CV_16SC2);
}

cv::Mat Rectifier::rectifyColor(const cv::Mat& image) const {
  if (isIdentity()) {
    return image;
  }
  OIKOS_CHECK(image.depth() == CV_8U && image.size() == map_px_.size());
  cv::Mat rectified;
  cv::remap(image, rectified, map_px_, map_fraction_, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return rectified;
}

}  // namespace oikos::camera
