// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/wheel_odometry.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/base/config_rules.h"
#include "core/geometry/se3.h"

namespace oikos::mapping {

void WheelWay::add(const Eigen::Isometry3d& T_before_after) {
  way_m += T_before_after.translation().norm();
  turn_rad += Eigen::AngleAxisd(T_before_after.linear()).angle();
}

std::vector<std::string> WheelGate::validate() const {
  return base::ConfigRules().greater("slack_m", slack_m, 0.0).greater("slack_deg", slack_deg, 0.0).atLeast("slip", slip, 0.0).messages();
}

bool WheelGate::allows(const Eigen::Isometry3d& T_expected_seen, const WheelWay& since) const {
  const double off_rad = Eigen::AngleAxisd(T_expected_seen.linear()).angle();
  return T_expected_seen.translation().norm() <= slack_m + slip * since.way_m &&
         off_rad <= slack_deg * std::numbers::pi / 180.0 + slip * since.turn_rad;
}

WheelOdometry::WheelOdometry(std::optional<recording::Trajectory> T_odom_base, const std::optional<Eigen::Isometry3d>& T_base_camera) {
  if (!T_odom_base || !T_base_camera) {
    return;
  }
  T_odom_camera_ = std::move(*T_odom_base);
  for (recording::StampedPose& pose : T_odom_camera_) {
    pose.T_map_camera = pose.T_map_camera * *T_base_camera;
  }
}

std::optional<Eigen::Isometry3d> WheelOdometry::findMotion(std::int64_t from_ns, std::int64_t to_ns) const {
  const auto T_odom_from = findCameraPose(from_ns);
  const auto T_odom_to = findCameraPose(to_ns);
  if (!T_odom_from || !T_odom_to) {
    return std::nullopt;
  }
  return T_odom_from->inverse() * *T_odom_to;
}

std::optional<Eigen::Isometry3d> WheelOdometry::findCameraPose(std::int64_t stamp_ns) const {
  constexpr std::int64_t kMaxGap_ns = 500'000'000;
  const auto after = std::lower_bound(T_odom_camera_.begin(), T_odom_camera_.end(), stamp_ns,
                                      [](const auto& pose, std::int64_t t) { return pose.stamp_ns < t; });
  if (after == T_odom_camera_.end()) {
    return std::nullopt;
  }
  if (after->stamp_ns == stamp_ns) {
    return after->T_map_camera;
  }
  if (after == T_odom_camera_.begin() || after->stamp_ns - std::prev(after)->stamp_ns > kMaxGap_ns) {
    return std::nullopt;
  }
  const auto before = std::prev(after);
  const double fraction = static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(after->stamp_ns - before->stamp_ns);
  return geometry::interpolate(before->T_map_camera, after->T_map_camera, fraction);
}

}  // namespace oikos::mapping
