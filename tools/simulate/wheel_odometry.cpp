// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/wheel_odometry.h"

#include <cmath>
#include <numbers>

#include "tools/simulate/dice.h"

namespace oikos::simulate {

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

FloorPose floorPoseOf(const Eigen::Isometry3d& T) {
  return {T.translation().head<2>(), std::atan2(T.linear()(1, 0), T.linear()(0, 0))};
}

}  // namespace

recording::Trajectory makeWheelOdometry(const recording::Trajectory& T_map_base, const OdometrySettings& settings, std::uint64_t seed) {
  constexpr double kSlip = 0.3;  // of the drift, drawn anew at each step
  Dice dice(seed + 601);
  const double way_scale = 1.0 + settings.drift_share * dice.gaussian();
  const double turn_scale = 1.0 + settings.turn_drift_share * dice.gaussian();
  recording::Trajectory odometry;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < T_map_base.size(); ++i) {
    if (i > 0) {
      const FloorPose step = floorPoseOf(T_map_base[i - 1].T_map_camera.inverse() * T_map_base[i].T_map_camera);
      const double way = way_scale + kSlip * settings.drift_share * dice.gaussian();
      const double turn = turn_scale + kSlip * settings.turn_drift_share * dice.gaussian();
      T_odom_base = T_odom_base * FloorPose{way * step.position_m, turn * step.yaw_rad}.T_map_base();
    }
    odometry.push_back({T_map_base[i].stamp_ns, T_odom_base});
  }
  return odometry;
}

recording::Trajectory makePrior(const recording::Trajectory& T_map_base, const OdometrySettings& settings, std::uint64_t seed) {
  constexpr double kMemory_s = 1.0;  // after which an error has halved, and another has come
  Dice dice(seed + 701);
  recording::Trajectory prior;
  Eigen::Vector3d error(dice.gaussian(), dice.gaussian(), dice.gaussian());
  for (std::size_t i = 0; i < T_map_base.size(); ++i) {
    if (i > 0) {
      const double step_s = 1e-9 * static_cast<double>(T_map_base[i].stamp_ns - T_map_base[i - 1].stamp_ns);
      const double kept = std::pow(0.5, step_s / kMemory_s);
      error = kept * error + std::sqrt(1.0 - kept * kept) * Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian());
    }
    FloorPose pose = floorPoseOf(T_map_base[i].T_map_camera);
    pose.position_m += settings.prior_m * error.head<2>();
    pose.yaw_rad += settings.prior_deg * kRadPerDeg * error.z();
    prior.push_back({T_map_base[i].stamp_ns, pose.T_map_base()});
  }
  return prior;
}

}  // namespace oikos::simulate
