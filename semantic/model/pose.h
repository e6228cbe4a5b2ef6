// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/degrees.h"

namespace oikos::semantic {

using base::kRadPerDeg;

/// A pose as home.xml writes it, R = Rz(yaw) Ry(pitch) Rx(roll); what it is a pose of, and in which frame, says the name of its member.
struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d roll_pitch_yaw_rad = Eigen::Vector3d::Zero();

  /// With a pitch from -90 to 90 degrees.
  [[nodiscard]] static Pose fromIsometry(const Eigen::Isometry3d& T) {
    const Eigen::Matrix3d& R = T.linear();
    return {T.translation(), {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0))}};
  }
  [[nodiscard]] Eigen::Isometry3d toIsometry() const {
    return Eigen::Translation3d(position_m) * Eigen::AngleAxisd(roll_pitch_yaw_rad.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(roll_pitch_yaw_rad.y(), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(roll_pitch_yaw_rad.x(), Eigen::Vector3d::UnitX());
  }
  bool operator==(const Pose&) const = default;
};

/// A box with its centre's pose in the frame of what it bounds.
struct Box {
  Pose center;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  bool operator==(const Box&) const = default;
};

}  // namespace oikos::semantic
