// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/scan_view.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "core/base/error.h"
#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

/// A wall `depth_m` before the camera, which looks along z of the map.
LocatedScan wallScan(double depth_m) {
  LocatedScan scan;
  scan.camera = test::smallCamera();
  scan.depth_m = cv::Mat(scan.camera.height, scan.camera.width, CV_32FC1, cv::Scalar(depth_m));
  return scan;
}

TEST(ScanView, SeesThroughWhatIsClearOfTheWall) {
  const ScanView view(wallScan(2.0), {}, 0.05);
  const double tolerance_m = *view.findTolerance_m({0.0, 0.0, 1.9});
  EXPECT_EQ(view.look({0.0, 0.0, 2.0 - 1.05 * tolerance_m}, 1.0).sight, Sight::kThrough);
  EXPECT_EQ(view.look({0.0, 0.0, 2.0 - 0.9 * tolerance_m}, 1.0).sight, Sight::kNearSurface);
  EXPECT_EQ(view.look({0.0, 0.0, 2.0 - 0.9 * tolerance_m}, 0.5).sight, Sight::kThrough);
}

TEST(ScanView, SaysNothingOfWhatIsHiddenOutOfViewOrOutOfRange) {
  const ScanView view(wallScan(2.0), {}, 0.05);
  EXPECT_EQ(view.look({0.0, 0.0, 2.5}, 1.0).sight, Sight::kNothing);
  EXPECT_EQ(view.look({0.0, 0.0, -1.0}, 1.0).sight, Sight::kNothing);
  EXPECT_EQ(view.look({3.0, 0.0, 1.0}, 1.0).sight, Sight::kNothing);
  EXPECT_EQ(view.look({0.56, 0.0, 1.0}, 1.0).sight, Sight::kNothing);  // in the image, not with all its neighbours
  EXPECT_EQ(view.look({0.0, 0.0, 0.1}, 1.0).sight, Sight::kNothing);
  const ScanView far_wall(wallScan(6.0), {}, 0.05);
  EXPECT_EQ(far_wall.look({0.0, 0.0, 4.5}, 1.0).sight, Sight::kNothing);
}

TEST(ScanView, MissingDepthIsNoFreeSpace) {
  LocatedScan scan = wallScan(2.0);
  scan.depth_m.colRange(70, 90).setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(ScanView(scan, {}, 0.05).look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kNothing);
  scan.depth_m.colRange(70, 90).setTo(0.0F);
  EXPECT_EQ(ScanView(scan, {}, 0.05).look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kNothing);
}

/// A pole of 2.2 cm, 1 m before the camera, as an eighth of the pixels within the tolerance.
TEST(ScanView, AThinThingWithoutReadingsIsNotSeenThrough) {
  LocatedScan scan = wallScan(2.0);
  EXPECT_EQ(ScanView(scan, {}, 0.05).look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kThrough);
  for (int left = 74; left < 84; ++left) {
    LocatedScan pole = wallScan(2.0);
    pole.depth_m.colRange(left, left + 3).setTo(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(ScanView(pole, {}, 0.05).look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kNothing) << "column " << left;
  }
}

/// As many readings are missing, nowhere two beside each other.
TEST(ScanView, SpecksWithoutReadingsHideNothing) {
  LocatedScan scan = wallScan(2.0);
  for (int v = 0; v < scan.depth_m.rows; ++v) {
    for (int u = v % 2 == 0 ? 0 : 4; u < scan.depth_m.cols; u += 8) {
      scan.depth_m.at<float>(v, u) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  EXPECT_EQ(ScanView(scan, {}, 0.05).look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kThrough);
}

TEST(ScanView, SomethingNearThePixelHidesThePoint) {
  LocatedScan scan = wallScan(2.0);
  scan.depth_m.colRange(84, 88).setTo(1.0);  // 5 px beside the point's pixel: 4 cm at 1 m
  EXPECT_NE(ScanView(scan, {}, 0.05).look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kThrough);
}

TEST(ScanView, SigmaIsThatOfPerturbedPoses) {
  LocatedScan scan = wallScan(2.0);
  scan.covariance.diagonal() << 1e-4, 4e-4, 1e-4, 1e-4, 9e-4, 2e-4;
  scan.covariance(1, 5) = scan.covariance(5, 1) = 1e-4;
  ChangeConfig config;
  config.depth_sigma_1m = 0.0;
  config.map_sigma_m = 0.0;
  const Eigen::Vector3d point(0.3, -0.2, 2.0);
  const Eigen::Matrix<double, 6, 6> root = scan.covariance.llt().matrixL();
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    Eigen::Matrix<double, 6, 1> xi;
    for (double& value : xi) {
      value = normal(random);
    }
    xi = root * xi;
    const Eigen::Vector3d turn = xi.tail<3>();
    const Eigen::Vector3d moved = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * point + xi.head<3>();
    sum += (moved - point) * (moved - point).transpose();
  }
  const double largest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum / kSamples).eigenvalues()[2];
  EXPECT_NEAR(ScanView(scan, config, 0.05).sigma_m(point), std::sqrt(largest), 0.02 * std::sqrt(largest));  // 1/√(2n) = 0.5 %
}

TEST(ScanView, APoseTooUncertainTellsNothing) {
  LocatedScan scan = wallScan(2.0);
  scan.covariance.diagonal().tail<3>().setConstant(0.1 * 0.1);
  const ScanView view(scan, {}, 0.05);
  EXPECT_FALSE(view.findTolerance_m({0.0, 0.0, 1.5}));
  EXPECT_EQ(view.look({0.0, 0.0, 1.0}, 1.0).sight, Sight::kNothing);
}

TEST(ScanView, RefusesBrokenScans) {
  LocatedScan wrong_size = wallScan(2.0);
  wrong_size.camera.width = 100;
  EXPECT_THROW(ScanView(wrong_size, {}, 0.05), base::ContractViolation);
  LocatedScan no_pose = wallScan(2.0);
  no_pose.T_map_camera.translation().x() = std::nan("");
  EXPECT_THROW(ScanView(no_pose, {}, 0.05), base::ContractViolation);
  LocatedScan negative = wallScan(2.0);
  negative.covariance(2, 2) = -1.0;
  EXPECT_THROW(ScanView(negative, {}, 0.05), base::ContractViolation);
  LocatedScan lopsided = wallScan(2.0);
  lopsided.covariance(0, 1) = 1.0;
  EXPECT_THROW(ScanView(lopsided, {}, 0.05), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::mapping
