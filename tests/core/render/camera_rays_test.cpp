// SPDX-License-Identifier: Apache-2.0
#include "core/render/camera_rays.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace oikos::render {
namespace {

const camera::PinholeCamera kCamera{.width = 64, .height = 48, .fx = 52.0, .fy = 53.0, .cx = 31.2, .cy = 23.9};

Eigen::Vector2d pixelOf(const Eigen::Vector2d& ray, const camera::LensDistortion& distortion) {
  return kCamera.project(distortion.distort(ray).homogeneous());
}

TEST(CameraRays, WithoutDistortionAreThePinholes) {
  const CameraRays rays(kCamera);
  EXPECT_LT((rays.at(7, 11) - kCamera.ray(7, 11).head<2>()).norm(), 1e-15);
  EXPECT_LT((rays.at(7, 11, {0.25, -0.5}) - kCamera.ray(7.25, 10.5).head<2>()).norm(), 1e-15);
}

TEST(CameraRays, FallOnTheirPixelThroughTheLens) {
  const camera::LensDistortion distortion{.k1 = 0.26, .k2 = -0.95, .p1 = -0.005, .p2 = 0.003, .k3 = 1.16};
  const CameraRays rays(kCamera, distortion);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      EXPECT_NEAR((pixelOf(rays.at(u, v), distortion) - Eigen::Vector2d(u, v)).norm(), 0.0, 1e-9);
      EXPECT_NEAR((pixelOf(rays.at(u, v, {0.4, -0.3}), distortion) - Eigen::Vector2d(u + 0.4, v - 0.3)).norm(), 0.0, 1e-2);
    }
  }
}

TEST(CameraRays, ALensThatFoldsBackIsRefused) {
  test::expectError(base::ErrorCode::kInput, {"has no inverse"}, [] { CameraRays(kCamera, camera::LensDistortion{.k1 = -2.0}); });
}

}  // namespace
}  // namespace oikos::render
