// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "mapping/volume/floor_finder.h"

namespace oikos::mapping {

/// `T_map_world` of a new map: z and tilt from the floor; x, y and heading from the base at the first frame, where the mount is known, else
/// from the camera there.
[[nodiscard]] Eigen::Isometry3d mapFrame(const FloorResult& floor, const Eigen::Isometry3d& T_world_first_camera,
                                         const std::optional<Eigen::Isometry3d>& T_base_camera);

}  // namespace oikos::mapping
