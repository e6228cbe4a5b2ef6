// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

namespace oikos::geometry {

/// The pose that files write as `tx ty tz qx qy qz qw` (metres, Hamilton). A quaternion whose norm is off by up to 1e-3 (numbers
/// printed with few decimals) is normalised; nothing if it is farther off or a number is not finite.
[[nodiscard]] inline std::optional<Eigen::Isometry3d> poseFromNumbers(const std::array<double, 7>& n) {
  for (const double value : n) {
    if (!std::isfinite(value)) {
      return std::nullopt;
    }
  }
  const Eigen::Quaterniond rotation(n[6], n[3], n[4], n[5]);
  if (std::abs(rotation.norm() - 1.0) > 1e-3) {
    return std::nullopt;
  }
  return Eigen::Translation3d(n[0], n[1], n[2]) * rotation.normalized();
}

}  // namespace oikos::geometry
