// SPDX-License-Identifier: Apache-2.0
#include "core/camera/rectifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/camera/depth_registration.h"

namespace oikos::camera {
namespace {

Calibration bentCamera() {
  Calibration calibration;
  calibration.color = {160, 120, 129.0, 128.0, 79.3, 61.2};
  calibration.distortion = {0.26, -0.95, -0.0054, 0.0026, 1.16};
  return calibration;
}

/// A smooth scene: grey value by undistorted direction.
double sceneGray(const Eigen::Vector2d& direction) {
  return 128.0 + 60.0 * std::sin(4.0 * direction.x()) + 50.0 * std::cos(5.0 * direction.y());
}

/// Undistorted direction of a stored pixel, by fixed-point iteration.
Eigen::Vector2d undistorted(const Calibration& calibration, double u, double v) {
  const Eigen::Vector2d stored = calibration.color.ray(u, v).head<2>();
  Eigen::Vector2d direction = stored;
  for (int i = 0; i < 200; ++i) {
    direction += stored - calibration.distortion.distort(direction);
  }
  return direction;
}

TEST(Rectifier, MakesAPinholeOfABentImage) {
  const Calibration calibration = bentCamera();
  const PinholeCamera& camera = calibration.color;
  cv::Mat stored(camera.height, camera.width, CV_8UC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      stored.at<uchar>(v, u) = static_cast<uchar>(std::lround(sceneGray(undistorted(calibration, u, v))));
    }
  }
  const Rectifier rectifier(camera, calibration.distortion);
  const cv::Mat rectified = rectifier.rectifyColor(stored);
  int compared = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (rectifier.sourceIndex()[static_cast<std::size_t>(v * camera.width + u)] < 0) {
        EXPECT_EQ(rectified.at<uchar>(v, u), 0) << u << "," << v;
        continue;
      }
      // rounding twice, and 1/64 px of the maps on a slope of at most 3 grey values a pixel
      EXPECT_NEAR(rectified.at<uchar>(v, u), sceneGray(camera.ray(u, v).head<2>()), 1.6) << u << "," << v;
      ++compared;
    }
  }
  EXPECT_GT(compared, 160 * 120 * 8 / 10);
}

TEST(Rectifier, WithoutDistortionNothingIsTouched) {
  const Rectifier rectifier(bentCamera().color, {});
  EXPECT_TRUE(rectifier.isIdentity());
  const cv::Mat image(120, 160, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(rectifier.rectifyColor(image).data, image.data);
}

TEST(Rectifier, RegisteredDepthFollowsWithoutMixing) {
  Calibration calibration = bentCamera();
  calibration.depth_scale = 1000.0;
  cv::Mat stored(120, 160, CV_16UC1, cv::Scalar(1000));
  stored.colRange(80, 160).setTo(3000);
  stored.at<std::uint16_t>(60, 40) = 0;
  stored.at<std::uint16_t>(60, 41) = 65535;
  const Rectifier rectifier(calibration.color, calibration.distortion);
  const cv::Mat depth_m = DepthRegistration(calibration, rectifier).toMetres(stored);
  int unread = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const float depth = depth_m.at<float>(v, u);
      const int source = rectifier.sourceIndex()[static_cast<std::size_t>(v * 160 + u)];
      if (std::isnan(depth)) {
        EXPECT_TRUE(source < 0 || source == 60 * 160 + 40 || source == 60 * 160 + 41);
        ++unread;
      } else {
        EXPECT_LT(std::min(std::abs(depth - 1.0F), std::abs(depth - 3.0F)), 1e-6F);
      }
    }
  }
  EXPECT_GE(unread, 2);
}

}  // namespace
}  // namespace oikos::camera
