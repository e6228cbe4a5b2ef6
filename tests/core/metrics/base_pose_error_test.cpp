// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/base_pose_error.h"

#include <gtest/gtest.h>

namespace oikos::metrics {
namespace {

Eigen::Isometry3d poseAt(double x_m, double y_m, double yaw_rad) {
  return Eigen::Translation3d(x_m, y_m, 0.0) * Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

TEST(BasePoseError, IsThatOfEachCoordinate) {
  const std::vector<PosePair> pairs{{0, poseAt(1.03, 2.0, 0.1), poseAt(1.0, 2.04, 0.0)}, {1, poseAt(0.0, 0.0, 0.0), poseAt(0.0, 0.0, 0.0)}};
  const BasePoseError error = evaluateBasePoses(pairs);
  EXPECT_EQ(error.position_m.count, 2);
  EXPECT_NEAR(error.position_m.max, 0.05, 1e-12);
  EXPECT_NEAR(error.x_m.mean, 0.015, 1e-12);
  EXPECT_NEAR(error.y_m.mean, 0.02, 1e-12);
  EXPECT_NEAR(error.yaw_rad.max, 0.1, 1e-12);
  EXPECT_NEAR(error.rotation_rad.max, 0.1, 1e-12);
}

TEST(BasePoseError, YawIsCountedTheShortWayRound) {
  const BasePoseError error = evaluateBasePoses({{0, poseAt(0.0, 0.0, 3.1), poseAt(0.0, 0.0, -3.1)}});
  EXPECT_NEAR(error.yaw_rad.max, 2.0 * 3.14159265358979 - 6.2, 1e-9);
}

TEST(BasePoseError, TiltIsRotationButNoYaw) {
  Eigen::Isometry3d tilted = Eigen::Isometry3d::Identity();
  tilted.linear() = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const BasePoseError error = evaluateBasePoses({{0, tilted, Eigen::Isometry3d::Identity()}});
  EXPECT_NEAR(error.rotation_rad.max, 0.02, 1e-12);
  EXPECT_NEAR(error.yaw_rad.max, 0.0, 1e-12);
}

TEST(BasePoseError, OfNothingIsNothing) {
  EXPECT_EQ(evaluateBasePoses({}).position_m.count, 0);
}

}  // namespace
}  // namespace oikos::metrics
