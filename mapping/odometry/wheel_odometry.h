// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/trajectory.h"

namespace oikos::mapping {

/// How far the wheels went and turned.
struct WheelWay {
  double way_m = 0.0;
  double turn_rad = 0.0;
  void add(const Eigen::Isometry3d& T_before_after);
};

/// How far a pose may be from where the wheels put the camera: they slip, and on carpet they count too much.
struct WheelGate {
  double slack_m = 0.08;
  double slack_deg = 6.0;
  double slip = 0.15;  ///< share of the way, and of the turn

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("slack_m", slack_m);
    visitor("slack_deg", slack_deg);
    visitor("slip", slip);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
  [[nodiscard]] bool allows(const Eigen::Isometry3d& T_expected_seen, const WheelWay& since) const;
};

/// The recording's `odometry.txt` (T_odom_base) seen from the camera: how it moved between any two stamps.
class WheelOdometry {
 public:
  WheelOdometry() = default;
  /// Without odometry, or without the camera's mount on the base, no motion is known.
  WheelOdometry(std::optional<recording::Trajectory> T_odom_base, const std::optional<Eigen::Isometry3d>& T_base_camera);

  /// Interpolated; nothing if a stamp is outside the recorded time or in a gap of more than half a second.
  [[nodiscard]] std::optional<Eigen::Isometry3d> findMotion(std::int64_t from_ns, std::int64_t to_ns) const;

 private:
  [[nodiscard]] std::optional<Eigen::Isometry3d> findCameraPose(std::int64_t stamp_ns) const;
  recording::Trajectory T_odom_camera_;
};

}  // namespace oikos::mapping
