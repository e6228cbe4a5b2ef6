// SPDX-License-Identifier: Apache-2.0
#include "tools/mount_options.h"

#include <CLI/Option.hpp>

namespace oikos::tools {

void declareMountOptions(CLI::App& command, MountOptions& options) {
  auto* const robot = command.add_option("--robot", options.robot, "URDF of the robot that carries the camera");
  auto* const camera_link = command.add_option("--camera-link", options.links.camera, "its optical link (z forward, y down)");
  auto* const base_link = command.add_option("--base-link", options.links.base, "its base link (x forward, z up, on the floor)");
  robot->needs(camera_link)->needs(base_link);
  camera_link->needs(robot);
  base_link->needs(robot);
}

std::optional<Eigen::Isometry3d> mountOf(const MountOptions& options, const recording::Recording& recording) {
  return options.robot.empty() ? recording.T_base_camera() : mapping::readMount(options.robot, options.links);
}

}  // namespace oikos::tools
