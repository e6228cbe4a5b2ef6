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
