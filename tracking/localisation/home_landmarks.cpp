// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/home_landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/model/primitives.h"
#include "core/model/triangle_mesh.h"
#include "semantic/model/home_models.h"

namespace oikos::tracking {

namespace {

constexpr double kWallHeight_m = 2.5;
constexpr double kBehind_m = 0.05;  ///< outwards of the outline: what hangs on the wall stays before it, the next room's behind it
constexpr double kThickness_m = 0.01;

/// Twice the area, positive if the corners go round to the left.
double signedArea(const std::vector<Eigen::Vector2d>& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area;
}

/// Nothing is seen through a wall. (Nor through its open doors, as far as this goes.)
model::TriangleMesh wallsOf(const std::vector<Eigen::Vector2d>& outline_map) {
  model::TriangleMesh walls;
  const double side = signedArea(outline_map) > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < outline_map.size(); ++i) {
    const Eigen::Vector2d& from = outline_map[i];
    const Eigen::Vector2d along = outline_map[(i + 1) % outline_map.size()] - from;
    const Eigen::Vector2d outwards = side * Eigen::Vector2d(along.y(), -along.x()).normalized();
    const Eigen::Vector2d middle = from + 0.5 * along + kBehind_m * outwards;
    const Eigen::Isometry3d T_map_wall = Eigen::Translation3d(middle.x(), middle.y(), 0.5 * kWallHeight_m) *
                                         Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Eigen::Vector3d::UnitZ());
    append(walls, model::makeBox(Eigen::Vector3d(along.norm() + 2.0 * kBehind_m, kThickness_m, kWallHeight_m).cast<float>()), T_map_wall);
  }
  return walls;
}

}  // namespace

registration::LandmarkScene makeLandmarks(const semantic::Home& home, const std::filesystem::path& home_folder) {
  registration::LandmarkScene landmarks;
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    if (!room.outline_map.empty()) {
      landmarks.addOccluder(wallsOf(room.outline_map));
    }
    for (const semantic::LargeObject& object : room.objects) {
      if (object.movability == semantic::Movability::kFixed) {
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
