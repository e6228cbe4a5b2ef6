// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/room_walls.h"

#include <cmath>
#include <cstddef>

#include "core/geometry/outline_area.h"
#include "core/model/primitives.h"

namespace oikos::tracking {

namespace {

constexpr double kWallHeight_m = 2.5;
constexpr double kThickness_m = 0.01;

}  // namespace

std::vector<RoomWall> wallsOf(const std::vector<Eigen::Vector2d>& outline_map, double behind_m) {
  std::vector<RoomWall> walls;
  const double side = geometry::signedDoubleArea(outline_map) > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < outline_map.size(); ++i) {
    const Eigen::Vector2d& from = outline_map[i];
    const Eigen::Vector2d along = outline_map[(i + 1) % outline_map.size()] - from;
    const Eigen::Vector2d outwards = side * Eigen::Vector2d(along.y(), -along.x()).normalized();
    const Eigen::Vector2d middle = from + 0.5 * along + (behind_m + 0.5 * kThickness_m) * outwards;
    const Eigen::Isometry3d T_map_wall = Eigen::Translation3d(middle.x(), middle.y(), 0.5 * kWallHeight_m) *
                                         Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Eigen::Vector3d::UnitZ());
    walls.push_back(
        {model::makeBox(Eigen::Vector3d(along.norm() + 2.0 * behind_m, kThickness_m, kWallHeight_m).cast<float>()), T_map_wall});
  }
  return walls;
}

}  // namespace oikos::tracking
