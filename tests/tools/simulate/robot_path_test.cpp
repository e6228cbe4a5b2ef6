// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/robot_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace oikos::simulate {
namespace {

constexpr double kPi = std::numbers::pi;

Waypoint waypoint(double x_m, double y_m, std::optional<double> yaw_rad = std::nullopt, double look_around_rad = 0.0) {
  Waypoint made;
  made.position_map = {x_m, y_m};
  made.yaw_rad = yaw_rad;
  made.look_around_rad = look_around_rad;
  return made;
}

FloorPose originPose() {
  return {};
}

constexpr RobotMotion kMotion{.speed_mps = 0.5, .acceleration_mps2 = 0.25, .turn_rate_radps = 0.8, .turn_acceleration_radps2 = 1.6};

/// Of a trapezoid, or of a triangle where the limit is not reached.
double durationOf(double length, double rate, double acceleration) {
  return length < rate * rate / acceleration ? 2.0 * std::sqrt(length / acceleration) : length / rate + rate / acceleration;
}

TEST(RobotPath, ALongLegIsATrapezoid) {
  const RobotPath path(originPose(), {waypoint(3.0, 0.0)}, kMotion);
  EXPECT_NEAR(path.duration_s(), 3.0 / 0.5 + 0.5 / 0.25, 1e-12);
  // Speeds up for 2 s over 0.5 m, cruises for 4 s over 2 m, slows down for 2 s.
  EXPECT_NEAR(path.at(1.0).position_m.x(), 0.125, 1e-12);
  EXPECT_NEAR(path.at(2.0).position_m.x(), 0.5, 1e-12);
  EXPECT_NEAR(path.at(4.0).position_m.x(), 1.5, 1e-12);
  EXPECT_NEAR(path.at(6.0).position_m.x(), 2.5, 1e-12);
  EXPECT_NEAR(path.at(7.0).position_m.x(), 2.875, 1e-12);
  EXPECT_NEAR(path.at(8.0).position_m.x(), 3.0, 1e-12);
}

TEST(RobotPath, AShortLegIsATriangle) {
  const RobotPath path(originPose(), {waypoint(0.25, 0.0)}, kMotion);
  EXPECT_NEAR(path.duration_s(), 2.0, 1e-12);
  EXPECT_NEAR(path.at(1.0).position_m.x(), 0.125, 1e-12);
  EXPECT_NEAR(path.at(0.5).position_m.x(), 0.03125, 1e-12);
}

TEST(RobotPath, TurnsTheShorterWayBeforeItDrives) {
  FloorPose start;
  start.yaw_rad = 3.0;
  const RobotPath path(start, {waypoint(-1.0, -0.2)}, kMotion);
  const double turn_rad = std::remainder(std::atan2(-0.2, -1.0) - 3.0, 2.0 * kPi);
  EXPECT_GT(turn_rad, 0.0);
  const double turn_s = durationOf(turn_rad, 0.8, 1.6);
  EXPECT_NEAR(path.duration_s(), turn_s + durationOf(std::hypot(1.0, 0.2), 0.5, 0.25), 1e-12);
  EXPECT_NEAR(path.at(0.5 * turn_s).yaw_rad, 3.0 + 0.5 * turn_rad, 1e-12);
  EXPECT_NEAR(path.at(0.5 * turn_s).position_m.norm(), 0.0, 1e-12);
}

TEST(RobotPath, LookAroundReturnsToHeadingPlusAngle) {
  for (const double look_rad : {2.0 * kPi, -70.0 * kPi / 180.0, 0.3}) {
    const RobotPath path(originPose(), {waypoint(0.0, 1.0, std::nullopt, look_rad)}, kMotion);
    const FloorPose end = path.at(path.duration_s());
    EXPECT_NEAR(end.yaw_rad, 0.5 * kPi + look_rad, 1e-12);
    const double look_s = durationOf(std::abs(look_rad), 0.8, 1.6);
    EXPECT_NEAR(path.at(path.duration_s() - 0.5 * look_s).yaw_rad, 0.5 * kPi + 0.5 * look_rad, 1e-9);
  }
}

const std::vector<Waypoint>& roundTrip() {
  static const std::vector<Waypoint> waypoints = {waypoint(1.0, 0.0), waypoint(1.0, 2.0, 0.3, -1.2), waypoint(1.0, 2.0),
                                                  waypoint(-0.5, 0.7, -2.0), waypoint(-0.5, 0.7, 3.0)};
  return waypoints;
}

TEST(RobotPath, EndsAtTheLastWaypointWithItsYaw) {
  const RobotPath path(originPose(), roundTrip(), kMotion);
  for (const double after_s : {0.0, 1e-9, 5.0}) {
    const FloorPose end = path.at(path.duration_s() + after_s);
    EXPECT_NEAR((end.position_m - Eigen::Vector2d(-0.5, 0.7)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(std::remainder(end.yaw_rad - 3.0, 2.0 * kPi), 0.0, 1e-12);
  }
}

TEST(RobotPath, IsContinuousAndKeepsItsLimits) {
  const RobotPath path(originPose(), roundTrip(), kMotion);
  constexpr double kStep_s = 1e-3;
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  for (double t = -0.5; t < path.duration_s() + 0.5; t += kStep_s) {
    const FloorPose a = path.at(t);
    const FloorPose b = path.at(t + kStep_s);
    const double speed = (b.position_m - a.position_m).norm() / kStep_s;
    const double turn_rate = (b.yaw_rad - a.yaw_rad) / kStep_s;
    EXPECT_LE(speed, kMotion.speed_mps + 1e-9) << t;
    EXPECT_LE(std::abs(turn_rate), kMotion.turn_rate_radps + 1e-9) << t;
    EXPECT_LE(std::abs(speed - speed_mps), kMotion.acceleration_mps2 * kStep_s + 1e-9) << t;
    EXPECT_LE(std::abs(turn_rate - turn_rate_radps), kMotion.turn_acceleration_radps2 * kStep_s + 1e-9) << t;
    speed_mps = speed;
    turn_rate_radps = turn_rate;
  }
}

TEST(RobotPath, LegsOfNoLengthTakeNoTime) {
  const RobotPath path(originPose(), {waypoint(0.0, 0.0), waypoint(0.0, 0.0, 0.0), waypoint(0.0, 0.0, 2.0 * kPi)}, kMotion);
  EXPECT_EQ(path.duration_s(), 0.0);
}

TEST(RobotPath, AnEmptyPathStandsStill) {
  FloorPose start;
  start.position_m = {1.0, -2.0};
  start.yaw_rad = 0.7;
  const RobotPath path(start, {}, kMotion);
  EXPECT_EQ(path.duration_s(), 0.0);
  for (const double t : {-1.0, 0.0, 10.0}) {
    EXPECT_EQ(path.at(t).position_m, start.position_m);
    EXPECT_EQ(path.at(t).yaw_rad, start.yaw_rad);
  }
}

TEST(RobotPath, BeforeTheStartItStands) {
  const RobotPath path(originPose(), {waypoint(1.0, 0.0)}, kMotion);
  EXPECT_EQ(path.at(-3.0).position_m, Eigen::Vector2d::Zero());
}

TEST(FloorPose, HasXForwardAndZUp) {
  FloorPose pose;
  pose.position_m = {1.0, 2.0};
  pose.yaw_rad = 0.5 * kPi;
  const Eigen::Isometry3d T_map_base = pose.T_map_base();
  EXPECT_NEAR((T_map_base * Eigen::Vector3d(1.0, 0.0, 0.5) - Eigen::Vector3d(1.0, 3.0, 0.5)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace oikos::simulate
