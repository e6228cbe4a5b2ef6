// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::tracking {

/// One wall of a room, a thin sheet as high as a room.
struct RoomWall {
  model::TriangleMesh mesh_wall;  ///< x along the wall, about its middle
  Eigen::Isometry3d T_map_wall = Eigen::Isometry3d::Identity();
};

/// The walls of an outline (corners in order, either way round), their inner sides `behind_m` outwards of it; wall i goes from corner i on.
[[nodiscard]] std::vector<RoomWall> wallsOf(const std::vector<Eigen::Vector2d>& outline_map, double behind_m);

}  // namespace oikos::tracking
