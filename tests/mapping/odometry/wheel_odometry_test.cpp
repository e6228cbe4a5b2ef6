// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/wheel_odometry.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/config_rules_check.h"

namespace oikos::mapping {
namespace {

Eigen::Isometry3d offBy(double metres, double degrees) {
  return Eigen::Translation3d(0.0, metres, 0.0) * Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
}

TEST(WheelGate, AllowsItsSlackWhereTheWheelsStandStill) {
  const WheelGate gate{.slack_m = 0.1, .slack_deg = 5.0, .slip = 0.2};
  EXPECT_TRUE(gate.allows(offBy(0.099, 4.9), {}));
  EXPECT_FALSE(gate.allows(offBy(0.101, 0.0), {}));
  EXPECT_FALSE(gate.allows(offBy(0.0, 5.1), {}));
}

TEST(WheelGate, AllowsSlipInProportionToTheWayAndTheTurn) {
  const WheelGate gate{.slack_m = 0.1, .slack_deg = 5.0, .slip = 0.2};
  WheelWay way;
  way.add(offBy(1.0, 30.0));
  way.add(offBy(-1.0, -30.0));  // back again: the wheels have slipped both ways
  EXPECT_DOUBLE_EQ(way.way_m, 2.0);
  EXPECT_TRUE(gate.allows(offBy(0.499, 16.9), way));
  EXPECT_FALSE(gate.allows(offBy(0.501, 0.0), way));
  EXPECT_FALSE(gate.allows(offBy(0.0, 17.1), way));
}

TEST(WheelGate, Rules) {
  test::checkConfigRules<WheelGate>(
      {{"slack_m", "0", "must be > 0"}, {"slack_deg", "nan", "must be > 0"}, {"slip", "-0.1", "must be >= 0"}});
}

TEST(WheelOdometry, KnowsNoMotionWithoutReadingsOrMount) {
  const recording::Trajectory readings = {{0, offBy(0.0, 0.0)}, {100, offBy(1.0, 0.0)}};
  EXPECT_FALSE(WheelOdometry().findMotion(0, 100));
  EXPECT_FALSE(WheelOdometry(readings, std::nullopt).findMotion(0, 100));
  EXPECT_TRUE(WheelOdometry(readings, Eigen::Isometry3d::Identity()).findMotion(0, 100));
  EXPECT_FALSE(WheelOdometry(readings, Eigen::Isometry3d::Identity()).findMotion(0, 101));
}

/// A mount ahead of the wheels' axis swings round when they turn on the spot.
TEST(WheelOdometry, IsTheCamerasMotion) {
  const recording::Trajectory turning = {{0, offBy(0.0, 0.0)}, {100, offBy(0.0, 90.0)}};
  const Eigen::Isometry3d T_base_camera(Eigen::Translation3d(0.2, 0.0, 1.0));
  const auto motion = WheelOdometry(turning, T_base_camera).findMotion(0, 100);
  ASSERT_TRUE(motion);
  EXPECT_LT((motion->translation() - Eigen::Vector3d(-0.2, 0.2, 0.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace oikos::mapping
