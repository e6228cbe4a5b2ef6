// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/home_landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/model/triangle_mesh.h"
#include "semantic/model/home_models.h"
#include "tracking/localisation/room_walls.h"

namespace oikos::tracking {

namespace {

constexpr double kBehind_m = 0.05;  ///< outwards of the outline: what hangs on the wall stays before it, the next room's behind it
constexpr double kAtWall_m = 0.5;   ///< from a wall to the middle of a piece that stands at it

/// Nothing is seen through a wall. (Nor through its open doors, as far as this goes.)
void addOccluders(const semantic::Room& room, registration::LandmarkScene& landmarks) {
  model::TriangleMesh walls;
  for (const RoomWall& wall : wallsOf(room.outline_map, kBehind_m)) {
    append(walls, wall.mesh_wall, wall.T_map_wall);
  }
  landmarks.addOccluder(walls);
}

double distance_m(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - from - share * along).norm();
}

/// Where fixed furniture stands at a wall, the wall was measured with it.
bool hasFurniture(const semantic::Room& room, std::size_t wall) {
  const Eigen::Vector2d& from = room.outline_map[wall];
  const Eigen::Vector2d& to = room.outline_map[(wall + 1) % room.outline_map.size()];
  return std::any_of(room.objects.begin(), room.objects.end(), [&](const semantic::LargeObject& object) {
    return object.movability == semantic::Movability::kFixed && distance_m(object.T_map_object.position_m.head<2>(), from, to) < kAtWall_m;
  });
}

bool isLeftOut(const std::string& id, const LandmarkChoice& choice) {
  return std::find(choice.without.begin(), choice.without.end(), id) != choice.without.end();
}

void addWalls(const semantic::Room& room, const LandmarkChoice& choice, registration::LandmarkScene& landmarks) {
  const std::vector<RoomWall> walls = wallsOf(room.outline_map, 0.0);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    model::ArticulatedModel model;
    model.name = room.id.value + "/wall-" + std::to_string(i + 1);  // no piece can be called so
    if (isLeftOut(model.name, choice) || !hasFurniture(room, i)) {
      continue;
    }
    const RoomWall& wall = walls[i];
    model.parts.push_back({"wall", std::make_shared<const model::TriangleMesh>(wall.mesh_wall)});
    landmarks.add(model.name, model, wall.T_map_wall, {});
  }
}

bool isChosen(const semantic::LargeObject& object, const LandmarkChoice& choice) {
  return !isLeftOut(object.id.value, choice) && (object.movability == semantic::Movability::kFixed ||
                                                 (choice.has_shiftable && object.movability == semantic::Movability::kShiftable));
}

}  // namespace

registration::LandmarkScene makeLandmarks(const semantic::Home& home, const std::filesystem::path& home_folder,
                                          const LandmarkChoice& choice) {
  registration::LandmarkScene landmarks;
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    if (!room.outline_map.empty()) {
      addOccluders(room, landmarks);
      if (choice.has_walls) {
        addWalls(room, choice, landmarks);
      }
    }
    for (const semantic::LargeObject& object : room.objects) {
      if (isChosen(object, choice)) {
        landmarks.add(object.id.value, maker.make(object), object.T_map_object.toIsometry(), semantic::jointValues(object));
      }
    }
  }
  return landmarks;
}

int getLandmark(const registration::LandmarkScene& landmarks, const semantic::Home& home, const std::string& id) {
  const auto found = std::find(landmarks.ids().begin(), landmarks.ids().end(), id);
  if (found != landmarks.ids().end()) {
    return static_cast<int>(found - landmarks.ids().begin());
  }
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.id.value == id) {
        throw base::Error(base::ErrorCode::kUsage,
                          "'" + id + "' is " + std::string(base::toString(object.movability)) + ": only fixed furniture can be a landmark",
                          "--object");
      }
    }
  }
  throw base::Error(base::ErrorCode::kUsage, "no furniture '" + id + "'" + base::didYouMean(id, landmarks.ids()), "--object");
}

}  // namespace oikos::tracking
