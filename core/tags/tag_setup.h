// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "core/tags/tag_board.h"

namespace oikos::tags {

/// Where the camera that watches the robot hangs and what the robot carries: `tags.toml` beside the camera's pictures. Poses are
/// `tx ty tz qx qy qz qw`.
struct TagSetup {
  std::vector<double> T_map_camera = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};  ///< of the camera that watches
  std::vector<double> T_base_board = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  TagBoard board;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("T_map_camera", T_map_camera);
    visitor("T_base_board", T_base_board);
    visitor("board", board);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Throws Error{kInput} that names file, line or key, what was found and what would be right.
[[nodiscard]] TagSetup readTagSetup(const std::filesystem::path& file);

/// Of a setup that is valid.
[[nodiscard]] Eigen::Isometry3d poseOf(const std::vector<double>& numbers);
[[nodiscard]] std::vector<double> numbersOf(const Eigen::Isometry3d& T);

}  // namespace oikos::tags
