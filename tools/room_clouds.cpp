// SPDX-License-Identifier: Apache-2.0
#include "tools/room_clouds.h"

#include "core/geometry/ply.h"
#include "semantic/model/outline.h"

namespace oikos::tools {

namespace {

/// Points of its walls lie about the outline, and the map's error beside it.
constexpr double kBeyondOutline_m = 0.06;

geometry::ColoredCloud cut(const geometry::ColoredCloud& cloud_map, const std::vector<Eigen::Vector2d>& outline_map) {
  geometry::ColoredCloud room;
  for (std::size_t i = 0; i < cloud_map.points.size(); ++i) {
    const Eigen::Vector2d place_map = cloud_map.points[i].head<2>().cast<double>();
    if (semantic::isInside(place_map, outline_map) || semantic::distanceToEdge(place_map, outline_map) < kBeyondOutline_m) {
      room.points.push_back(cloud_map.points[i]);
      if (!cloud_map.colors.empty()) {
        room.colors.push_back(cloud_map.colors[i]);
      }
    }
  }
  return room;
}

}  // namespace

void writeRoomClouds(const semantic::Home& home, const std::filesystem::path& map_folder) {
  const geometry::ColoredCloud cloud_map = geometry::readPly(map_folder / "cloud.ply");
  for (const semantic::Room& room : home.rooms) {
    if (room.outline_map.size() >= 3) {
      std::filesystem::create_directory(map_folder / "rooms");
      writePly(cut(cloud_map, room.outline_map), map_folder / "rooms" / (room.id.value + ".ply"));
    }
  }
}

}  // namespace oikos::tools
