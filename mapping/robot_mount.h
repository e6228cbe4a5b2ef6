// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

namespace oikos::mapping {

/// Where to look in a robot's description for the camera's mount.
struct MountLinks {
  std::string base;    ///< x forward, z up, on the floor
  std::string camera;  ///< the optical link: z forward, x right, y down
};

/// `T_base_camera` from a URDF, every joint between the two links at zero. Throws Error{kInput} that names the file and the
/// link (with the nearest one that exists), Error{kIo} if the file cannot be read.
[[nodiscard]] Eigen::Isometry3d readMount(const std::filesystem::path& urdf, const MountLinks& links);

}  // namespace oikos::mapping
