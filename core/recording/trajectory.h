// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace oikos::recording {

/// A pose with its time: coordinates of the moving frame (camera or base) to those of the fixed one.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};
using Trajectory = std::vector<StampedPose>;

/// TUM format, `t tx ty tz qx qy qz qw` a line, '#' comments. Throws Error with file and line.
[[nodiscard]] Trajectory readTrajectory(const std::filesystem::path& file);
void writeTrajectory(const Trajectory& trajectory, const std::filesystem::path& file);

}  // namespace oikos::recording
