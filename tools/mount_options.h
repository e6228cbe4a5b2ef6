// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>

#include "core/recording/recording.h"
#include "mapping/robot_mount.h"

namespace oikos::tools {

/// `--robot URDF --camera-link NAME --base-link NAME`: all of them or none.
struct MountOptions {
  std::filesystem::path robot;
  mapping::MountLinks links;
};
void declareMountOptions(CLI::App& command, MountOptions& options);

/// `T_base_camera`: the robot's description wins over the recording's calibration. Throws Error.
[[nodiscard]] std::optional<Eigen::Isometry3d> mountOf(const MountOptions& options, const recording::Recording& recording);

}  // namespace oikos::tools
