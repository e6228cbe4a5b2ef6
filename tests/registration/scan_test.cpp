// SPDX-License-Identifier: Apache-2.0
#include "registration/scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/registration/furniture_scan.h"
#include "tests/support/config_rules_check.h"

namespace oikos::registration {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Depth of the plane normal · p = offset as the camera sees it.
cv::Mat planeDepth(const Eigen::Vector3d& normal_camera, double offset_m) {
  const camera::PinholeCamera camera = test::kinectCamera();
  cv::Mat depth_m(camera.height, camera.width, CV_32FC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      depth_m.at<float>(v, u) = static_cast<float>(offset_m / normal_camera.dot(camera.ray(u, v)));
    }
  }
  return depth_m;
}

TEST(Scan, PointsLieOnTheRaysOfTheThinnedPixels) {
  const camera::PinholeCamera camera = test::kinectCamera();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, 1.0).normalized();
  const Scan scan = makeScan(planeDepth(normal, 2.0), camera, {.step_px = 4});
  ASSERT_EQ(scan.camera.width, 160);
  ASSERT_EQ(scan.camera.height, 120);
  for (const auto& [u, v] : {std::pair{0, 0}, {80, 60}, {159, 119}}) {
    const Eigen::Vector3d point = scan.at(u, v).point_camera.cast<double>();
    EXPECT_NEAR(normal.dot(point), 2.0, 1e-5);
    EXPECT_LT((scan.camera.project(point) - Eigen::Vector2d(u, v)).norm(), 1e-4);
    EXPECT_LT((camera.project(point) - 4.0 * Eigen::Vector2d(u, v)).norm(), 1e-3);
  }
}

TEST(Scan, NormalsOfAPlaneAreItsOwnAndFaceTheCamera) {
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.5, 0.4, 1.0).normalized();
  const Scan scan = makeScan(planeDepth(normal, 1.5), test::kinectCamera(), {});
  for (const ScanPoint& point : scan.points) {
    if (point.point_camera.z() > 0.0F) {
      ASSERT_FALSE(point.normal_camera.isZero());
      EXPECT_GT(point.normal_camera.cast<double>().dot(-normal), std::cos(0.001));
    }
  }
}

TEST(Scan, ReadingsOutOfRangeAreNone) {
  cv::Mat depth_m(480, 640, CV_32FC1, cv::Scalar(2.0));
  depth_m.at<float>(0, 0) = kNan;
  depth_m.at<float>(0, 4) = 0.29F;
  depth_m.at<float>(0, 8) = 4.6F;
  depth_m.at<float>(0, 12) = std::numeric_limits<float>::infinity();
  const Scan scan = makeScan(depth_m, test::kinectCamera(), {});
  for (int u = 0; u < 4; ++u) {
    EXPECT_EQ(scan.at(u, 0).point_camera.z(), 0.0F) << u;
  }
  EXPECT_EQ(scan.at(4, 0).point_camera.z(), 2.0F);
}

/// A window that reaches over an edge fits to the near surface alone; where little is left of it, there is no normal.
TEST(Scan, NormalsKeepToTheirSurface) {
  cv::Mat depth_m(480, 640, CV_32FC1, cv::Scalar(3.0));
  depth_m.colRange(320, 640).setTo(1.5);
  const Scan scan = makeScan(depth_m, test::kinectCamera(), {});
  EXPECT_NEAR(scan.at(80, 60).normal_camera.z(), -1.0F, 1e-4F);
  EXPECT_NEAR(scan.at(79, 60).normal_camera.z(), -1.0F, 1e-4F);
  cv::Mat speck(480, 640, CV_32FC1, cv::Scalar(kNan));
  speck.at<float>(240, 320) = 1.0F;
  EXPECT_TRUE(makeScan(speck, test::kinectCamera(), {}).at(80, 60).normal_camera.isZero());
}

TEST(Scan, ThinningKeepsTheRays) {
  const Scan fine = makeScan(planeDepth(Eigen::Vector3d::UnitZ(), 2.0), test::kinectCamera(), {});
  const Scan coarse = thinned(fine, 2);
  EXPECT_EQ(coarse.camera.width, 80);
  EXPECT_EQ(coarse.at(13, 7).point_camera, fine.at(26, 14).point_camera);
  EXPECT_LT((coarse.camera.ray(13, 7) - fine.camera.ray(26, 14)).norm(), 1e-12);
}

TEST(Scan, ACropIsTheSamePointsOnTheSameRays) {
  const Scan whole = makeScan(planeDepth(Eigen::Vector3d(0.2, 0.1, 1.0).normalized(), 2.0), test::kinectCamera(), {});
  const Scan part = cropped(whole, {30, 20, 90, 70});
  ASSERT_EQ(part.camera.width, 60);
  ASSERT_EQ(part.camera.height, 50);
  EXPECT_EQ(part.at(7, 9).point_camera, whole.at(37, 29).point_camera);
  EXPECT_EQ(part.at(7, 9).normal_camera, whole.at(37, 29).normal_camera);
  EXPECT_LT((part.camera.ray(7, 9) - whole.camera.ray(37, 29)).norm(), 1e-12);
  EXPECT_TRUE(cropped(whole, {30, 20, 30, 20}).points.empty());
  EXPECT_THROW(static_cast<void>(cropped(whole, {0, 0, 161, 120})), base::ContractViolation);
}

/// The normal of each point is the one that a plain fit to its window gives.
TEST(Scan, NormalsAreThoseOfAPlainFit) {
  const camera::PinholeCamera camera = test::kinectCamera();
  cv::Mat depth_m(camera.height, camera.width, CV_32FC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int noise = (u * 7919 + v * 104729) % 1000;
      depth_m.at<float>(v, u) = noise < 50 ? kNan : static_cast<float>(1.5 + 0.001 * u + 0.0005 * v + (u > 300 ? 0.6 : 0.0) + 2e-6 * noise);
    }
  }
  const ScanConfig config;
  const Scan scan = makeScan(depth_m, camera, config);
  int fitted = 0;
  for (int v = 0; v < scan.camera.height; v += 7) {
    for (int u = 0; u < scan.camera.width; u += 7) {
      const double centre = 1.0 / static_cast<double>(depth_m.at<float>(4 * v, 4 * u));
      Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      int samples = 0;
      for (int dv = -6; dv <= 6; dv += 3) {
        for (int du = -6; du <= 6; du += 3) {
          const cv::Point pixel(4 * u + du, 4 * v + dv);
          if (pixel.x < 0 || pixel.y < 0 || pixel.x >= camera.width || pixel.y >= camera.height) {
            continue;
          }
          ++samples;
          const double q = 1.0 / static_cast<double>(depth_m.at<float>(pixel));
          if (std::abs(q - centre) < config.max_step_share * centre) {
            const Eigen::Vector3d row(du, dv, 1.0);
            squares += row * row.transpose();
            right += q * row;
          }
        }
      }
      if (!std::isfinite(centre) || 2.0 * squares(2, 2) < samples) {
        EXPECT_TRUE(scan.at(u, v).normal_camera.isZero());
        continue;
      }
      const Eigen::Vector3d q = squares.inverse() * right;
      const Eigen::Vector3d normal(q.x() * camera.fx, q.y() * camera.fy, q.z() - q.x() * (4 * u - camera.cx) - q.y() * (4 * v - camera.cy));
      EXPECT_LT((scan.at(u, v).normal_camera.cast<double>() + normal.normalized()).norm(), 1e-4) << u << " " << v;
      ++fitted;
    }
  }
  EXPECT_GT(fitted, 300);
}

TEST(Scan, AnImageOfAnotherSizeBreaksTheContract) {
  EXPECT_THROW(static_cast<void>(makeScan(cv::Mat(480, 639, CV_32FC1), test::kinectCamera(), {})), base::ContractViolation);
  EXPECT_THROW(static_cast<void>(makeScan(cv::Mat(480, 640, CV_16UC1), test::kinectCamera(), {})), base::ContractViolation);
}

TEST(Scan, Rules) {
  test::checkConfigRules<ScanConfig>({{"step_px", "0", "must be >= 1"},
                                      {"normal_radius_px", "1", "must be >= 2"},
                                      {"max_step_share", "0", "must be > 0"},
                                      {"min_range_m", "-1", "must be >= 0"},
                                      {"max_range_m", "0.3", "must be > 0.3"}});
}

}  // namespace
}  // namespace oikos::registration
