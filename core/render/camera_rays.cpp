// SPDX-License-Identifier: Apache-2.0
#include "core/render/camera_rays.h"

#include <string>

#include "core/base/error.h"

namespace oikos::render {

namespace {

/// Newton's method from the distorted point, with numeric derivatives: the model has no inverse in closed form.
Eigen::Vector2d undistort(const camera::LensDistortion& distortion, const Eigen::Vector2d& distorted) {
  constexpr double kStep = 1e-6;
  constexpr double kTolerance = 1e-12;
  Eigen::Vector2d undistorted = distorted;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d residual = distortion.distort(undistorted) - distorted;
    if (residual.norm() < kTolerance) {
      return undistorted;
    }
    Eigen::Matrix2d J;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
      J.col(axis) = (distortion.distort(undistorted + step) - distortion.distort(undistorted - step)) / (2.0 * kStep);
    }
    if (J.determinant() < 1e-3) {
      break;  // beyond the radius at which the model folds back
    }
    undistorted -= J.inverse() * residual;
  }
  throw base::Error(base::ErrorCode::kInput,
                    "the lens distortion has no inverse at (" + std::to_string(distorted.x()) + ", " + std::to_string(distorted.y()) +
                        ") of the image plane: its coefficients do not fit the image's size and focal length",
                    "distortion");
}

}  // namespace

CameraRays::CameraRays(const camera::PinholeCamera& camera, const camera::LensDistortion& distortion)
    : camera_(camera), per_fx_(1.0 / camera.fx), per_fy_(1.0 / camera.fy) {
  if (distortion.isZero()) {
    return;
  }
  rays_.reserve(static_cast<std::size_t>(camera.width + 2) * static_cast<std::size_t>(camera.height + 2));
  for (int v = -1; v <= camera.height; ++v) {
    for (int u = -1; u <= camera.width; ++u) {
      rays_.push_back(undistort(distortion, camera.ray(u, v).head<2>()));
    }
  }
}

}  // namespace oikos::render
