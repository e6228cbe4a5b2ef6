// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/unmodelled.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/model/small_objects.h"
#include "semantic/model/outline.h"
#include "tools/simulate/dice.h"
#include "tools/simulate/dressing.h"

namespace oikos::simulate {

namespace {

std::vector<Eigen::Vector2d> placesOf(const RobotPath& path, double until_s) {
  constexpr double kStep_s = 0.1;
  std::vector<Eigen::Vector2d> places_map;
  for (double time_s = 0.0; time_s < std::min(until_s, path.duration_s()) + kStep_s; time_s += kStep_s) {
    places_map.push_back(path.at(time_s).position_m);
  }
  return places_map;
}

bool isOnAFloor(const Eigen::Vector2d& place_map, double radius_m, const semantic::Home& home) {
  return std::any_of(home.rooms.begin(), home.rooms.end(), [&](const semantic::Room& room) {
    return room.outline_map.size() >= 3 && semantic::isInside(place_map, room.outline_map) &&
           semantic::distanceToEdge(place_map, room.outline_map) > radius_m;
  });
}

class FloorSearch {
 public:
  FloorSearch(const semantic::Home& home, const RobotPath& path, FreeFloor floor)
      : home_(home), way_map_(placesOf(path, floor.until_s)), floor_(std::move(floor)) {
    for (const semantic::Room& room : home.rooms) {
      for (const Eigen::Vector2d& corner : room.outline_map) {
        whole_.extend(corner);
      }
    }
  }

  /// A circle that touches nothing; it is taken from then on.
  [[nodiscard]] std::optional<Eigen::Vector2d> find(double radius_m, Dice& dice) {
    constexpr int kTries = 500;
    for (int i = 0; i < kTries && !whole_.isEmpty(); ++i) {
      const double x_m = dice.between(whole_.min().x(), whole_.max().x());
      const Eigen::Vector2d place_map(x_m, dice.between(whole_.min().y(), whole_.max().y()));
      if (isFree(place_map, radius_m)) {
        const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius_m);
        floor_.footprints_map.emplace_back(place_map - reach, place_map + reach);
        return place_map;
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool isFree(const Eigen::Vector2d& place_map, double radius_m) const {
    const double from_path_m = radius_m + floor_.beside_path_m;
    return isOnAFloor(place_map, radius_m, home_) &&
           std::none_of(way_map_.begin(), way_map_.end(), [&](const auto& p) { return (p - place_map).norm() < from_path_m; }) &&
           std::none_of(floor_.footprints_map.begin(), floor_.footprints_map.end(),
                        [&](const auto& box) { return box.exteriorDistance(place_map) < radius_m; });
  }

  const semantic::Home& home_;
  std::vector<Eigen::Vector2d> way_map_;
  FreeFloor floor_;
  Eigen::AlignedBox2d whole_;
};

model::ArticulatedModel boxOf(const Eigen::Vector3d& size_m, std::uint64_t seed) {
  model::BoxShape shape;
  shape.depth_m = size_m.x();
  shape.width_m = size_m.y();
  shape.height_m = size_m.z();
  model::ArticulatedModel box;
  box.parts.push_back({"box", std::make_shared<const model::TriangleMesh>(makeSmallBox(shape))});
  dress(box, "box", seed);
  return box;
}

/// A point of the surface, each as likely as another.
Eigen::Vector3d pointOn(const model::TriangleMesh& mesh, const std::vector<double>& areas_so_far, Dice& dice) {
  const double wanted = dice.next() * areas_so_far.back();
  const auto triangle = static_cast<std::size_t>(std::upper_bound(areas_so_far.begin(), areas_so_far.end(), wanted) - areas_so_far.begin());
  const model::TriangleMesh::Triangle& corners = mesh.triangles[std::min(triangle, mesh.triangles.size() - 1)];
  const double u = std::sqrt(dice.next());
  const double v = dice.next();
  return (1.0 - u) * mesh.vertices[corners[0]].cast<double>() + u * (1.0 - v) * mesh.vertices[corners[1]].cast<double>() +
         u * v * mesh.vertices[corners[2]].cast<double>();
}

/// A point of the surface on the front, a side or the top of a piece.
std::optional<Eigen::Vector3d> findOuterPlace(const model::TriangleMesh& mesh, Dice& dice) {
  constexpr int kTries = 100;
  constexpr double kOuter_m = 0.02;
  std::vector<double> areas_so_far;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    areas_so_far.push_back((areas_so_far.empty() ? 0.0 : areas_so_far.back()) + mesh.areaNormal(i).norm());
  }
  const Eigen::AlignedBox3d bounds = mesh.bounds().cast<double>();
  for (int i = 0; i < kTries; ++i) {
    const Eigen::Vector3d point = pointOn(mesh, areas_so_far, dice);
    const Eigen::Vector3d to_max = bounds.max() - point;
    if (std::min({to_max.x(), to_max.y(), to_max.z(), point.y() - bounds.min().y()}) < kOuter_m) {
      return point;
    }
  }
  return std::nullopt;
}

}  // namespace

void addUnmodelledPart(model::ArticulatedModel& piece, std::uint64_t seed) {
  if (piece.parts.empty() || !piece.parts.front().mesh_part || piece.parts.front().mesh_part->empty()) {
    return;
  }
  Dice dice(seed + 901);
  auto mesh = std::make_shared<model::TriangleMesh>(*piece.parts.front().mesh_part);
  const std::optional<Eigen::Vector3d> place_part = findOuterPlace(*mesh, dice);
  if (!place_part) {
    return;
  }
  const Eigen::Vector3d size_m(dice.between(0.04, 0.12), dice.between(0.04, 0.12), dice.between(0.04, 0.12));
  append(*mesh, *boxOf(size_m, seed).parts.front().mesh_part, Eigen::Isometry3d(Eigen::Translation3d(*place_part)));
  piece.parts.front().mesh_part = std::move(mesh);
}

std::vector<LooseBox> scatterBoxes(const semantic::Home& home, const RobotPath& path, FreeFloor floor, int count, std::uint64_t seed) {
  FloorSearch search(home, path, std::move(floor));
  Dice dice(seed + 951);
  std::vector<LooseBox> boxes;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size_m(dice.between(0.12, 0.4), dice.between(0.12, 0.4), dice.between(0.1, 0.5));
    const double yaw_rad = dice.between(0.0, 2.0 * std::numbers::pi);
    const std::optional<Eigen::Vector2d> place_map = search.find(0.5 * size_m.head<2>().norm(), dice);
    if (!place_map) {
      break;
    }
    LooseBox& box = boxes.emplace_back();
    box.model = boxOf(size_m, camera::mixBits(seed + static_cast<std::uint64_t>(i)));
    box.T_map_model = Eigen::Translation3d(place_map->x(), place_map->y(), 0.0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  }
  return boxes;
}

}  // namespace oikos::simulate
