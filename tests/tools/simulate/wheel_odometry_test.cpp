// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/wheel_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tools/simulate/statistics.h"

namespace oikos::simulate {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// At 10 Hz: `steps` of `way_m` forwards and a turn each, from somewhere on.
recording::Trajectory driveOf(int steps, double way_m, double turn_rad) {
  recording::Trajectory drive;
  Eigen::Isometry3d T_map_base = Eigen::Translation3d(1.0, -2.0, 0.0) * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ());
  for (int i = 0; i <= steps; ++i) {
    drive.push_back({std::int64_t{100'000'000} * i, T_map_base});
    T_map_base = T_map_base * Eigen::Translation3d(way_m, 0.0, 0.0) * Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ());
  }
  return drive;
}

double yawOf(const Eigen::Isometry3d& T) {
  return std::atan2(T.linear()(1, 0), T.linear()(0, 0));
}

TEST(WheelOdometry, WithoutDriftIsExact) {
  OdometrySettings settings;
  settings.drift_share = 0.0;
  settings.turn_drift_share = 0.0;
  const recording::Trajectory drive = driveOf(500, 0.05, 0.02);
  const recording::Trajectory odometry = makeWheelOdometry(drive, settings, 3);
  ASSERT_EQ(odometry.size(), drive.size());
  for (std::size_t i = 0; i < drive.size(); ++i) {
    EXPECT_EQ(odometry[i].stamp_ns, drive[i].stamp_ns);
    const Eigen::Isometry3d T_start_base = drive[0].T_map_camera.inverse() * drive[i].T_map_camera;
    EXPECT_TRUE(odometry[i].T_map_camera.isApprox(T_start_base, 1e-10)) << i;
  }
}

TEST(WheelOdometry, DriftsByItsShareOfTheWay) {
  OdometrySettings settings;
  settings.drift_share = 0.02;
  settings.turn_drift_share = 0.03;
  constexpr int kSteps = 100;
  const recording::Trajectory straight = driveOf(kSteps, 0.1, 0.0);
  const recording::Trajectory turning = driveOf(kSteps, 0.0, 0.02);
  std::vector<double> way_errors;
  std::vector<double> turn_errors;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Eigen::Isometry3d T = makeWheelOdometry(straight, settings, seed).back().T_map_camera;
    EXPECT_NEAR(T.translation().y(), 0.0, 1e-9);
    way_errors.push_back(T.translation().x() / 10.0 - 1.0);
    const Eigen::Isometry3d T_turned = makeWheelOdometry(turning, settings, seed).back().T_map_camera;
    EXPECT_NEAR(T_turned.translation().norm(), 0.0, 1e-12);
    turn_errors.push_back(yawOf(T_turned) / 2.0 - 1.0);
  }
  const double with_slip = std::sqrt(1.0 + 0.3 * 0.3 / kSteps);  // a share of each step, drawn anew
  expectGaussianSample(way_errors, 0.02 * with_slip);
  expectGaussianSample(turn_errors, 0.03 * with_slip);
}

TEST(WheelOdometry, StandsWhileTheRobotStands) {
  for (const recording::StampedPose& pose : makeWheelOdometry(driveOf(50, 0.0, 0.0), OdometrySettings(), 1)) {
    EXPECT_TRUE(pose.T_map_camera.isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  }
}

TEST(WheelOdometry, SeedsDiffer) {
  const recording::Trajectory drive = driveOf(10, 0.1, 0.1);
  const auto endOf = [&](std::uint64_t seed) { return makeWheelOdometry(drive, OdometrySettings(), seed).back().T_map_camera.matrix(); };
  EXPECT_EQ(endOf(1), endOf(1));
  EXPECT_NE(endOf(1), endOf(2));
}

TEST(Prior, KeepsItsDeviationsOverALongDrive) {
  OdometrySettings settings;
  settings.prior_m = 0.05;
  settings.prior_deg = 3.0;
  constexpr int kSteps = 60'000;  // 6,000 s
  const recording::Trajectory drive = driveOf(kSteps, 0.05, 0.01);
  const recording::Trajectory prior = makePrior(drive, settings, 9);
  ASSERT_EQ(prior.size(), drive.size());
  std::vector<double> shifts_m;
  std::vector<double> sides_m;
  std::vector<double> turns_rad;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const Eigen::Vector3d shift = prior[i].T_map_camera.translation() - drive[i].T_map_camera.translation();
    EXPECT_EQ(prior[i].stamp_ns, drive[i].stamp_ns);
    EXPECT_EQ(shift.z(), 0.0);
    shifts_m.push_back(shift.x());
    sides_m.push_back(shift.y());
    turns_rad.push_back(yawOf(drive[i].T_map_camera.inverse() * prior[i].T_map_camera));
  }
  // Errors halve in a second: they are worth one independent draw in 2 s / ln 2.
  const double independent = 0.1 * kSteps * std::numbers::ln2 / 2.0;
  expectGaussianSample(shifts_m, 0.05, independent);
  expectGaussianSample(sides_m, 0.05, independent);
  expectGaussianSample(turns_rad, 3.0 * kRadPerDeg, independent);
}

TEST(Prior, WandersSlowly) {
  OdometrySettings settings;
  settings.prior_m = 0.05;
  const recording::Trajectory drive = driveOf(20'000, 0.0, 0.0);
  const recording::Trajectory prior = makePrior(drive, settings, 4);
  std::vector<double> steps_m;
  for (std::size_t i = 1; i < prior.size(); ++i) {
    steps_m.push_back(prior[i].T_map_camera.translation().x() - prior[i - 1].T_map_camera.translation().x());
  }
  const double kept = std::pow(0.5, 0.1);
  expectGaussianSample(steps_m, 0.05 * std::sqrt(2.0 * (1.0 - kept)));
}

TEST(Prior, WithoutDeviationsIsExact) {
  OdometrySettings settings;
  settings.prior_m = 0.0;
  settings.prior_deg = 0.0;
  const recording::Trajectory drive = driveOf(100, 0.05, 0.1);
  const recording::Trajectory prior = makePrior(drive, settings, 4);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    EXPECT_TRUE(prior[i].T_map_camera.isApprox(drive[i].T_map_camera, 1e-12));
  }
}

}  // namespace
}  // namespace oikos::simulate
