// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace oikos::tools {

/// A place of the robot on the floor.
struct FloorPlace {
  Eigen::Vector2d position_map = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;

  [[nodiscard]] Eigen::Isometry3d T_map_base() const;
};

/// Reads `X,Y,YAW` (m, m, degrees). Throws Error{kUsage} that names `option`.
[[nodiscard]] FloorPlace parseFloorPlace(const std::string& text, const std::string& option);

}  // namespace oikos::tools
