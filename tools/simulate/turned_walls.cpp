// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/turned_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "semantic/model/home_models.h"

namespace oikos::simulate {

namespace {

using semantic::LargeObject;

constexpr double kBesideWall_m = 0.15;  // what is this near a wall and parallel to it belongs to it
constexpr double kParallelCosine = 0.996;

Eigen::Isometry2d frameOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool is_left) {
  const Eigen::Vector2d along = (is_left ? to - from : from - to).normalized();
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() << along.x(), -along.y(), along.y(), along.x();
  T.translation() = 0.5 * (from + to);
  return T;
}

Eigen::Isometry2d onFloor(const semantic::Pose& pose) {
  Eigen::Isometry2d T(Eigen::Rotation2Dd(pose.roll_pitch_yaw_rad.z()));
  T.translation() = pose.position_m.head<2>();
  return T;
}

/// The map's motion that takes a wall from where it is believed to where it is.
Eigen::Isometry2d motionOf(const TurnedWall& wall) {
  return wall.T_map_true * wall.T_map_believed.inverse();
}

void move(LargeObject& object, const Eigen::Isometry2d& motion) {
  semantic::Pose& pose = object.T_map_object;
  pose.position_m.head<2>() = motion * Eigen::Vector2d(pose.position_m.head<2>());
  pose.roll_pitch_yaw_rad.z() += std::atan2(motion.linear()(1, 0), motion.linear()(0, 0));
}

/// Of the body, in its own frame; none for a piece of a model file.
std::optional<Eigen::AlignedBox3d> bodyOf(const LargeObject& object) {
  if (!object.shape) {
    return std::nullopt;
  }
  const model::ArticulatedModel made = semantic::makeShape(*object.shape, "shape of '" + object.id.value + "'");
  const auto& mesh_part = made.parts.front().mesh_part;
  return mesh_part ? std::optional(mesh_part->bounds().cast<double>()) : std::nullopt;
}

struct Extent {
  double nearest_m;  ///< signed distance of the nearest corner from the wall, into the room
  double first_m;    ///< along the wall, from its middle
  double last_m;
};

Extent extentOf(const Eigen::AlignedBox3d& body, const Eigen::Isometry2d& T_map_object, const Eigen::Isometry2d& T_map_wall) {
  const Eigen::Isometry2d T_wall_object = T_map_wall.inverse() * T_map_object;
  Eigen::AlignedBox2d box;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d corner(i % 2 == 0 ? body.min().x() : body.max().x(), i / 2 == 0 ? body.min().y() : body.max().y());
    box.extend(T_wall_object * corner);
  }
  return {box.min().y(), box.min().x(), box.max().x()};
}

bool isAlong(const Extent& extent, double length_m) {
  return extent.last_m > -0.5 * length_m && extent.first_m < 0.5 * length_m;
}

/// The wall that a piece has at its back, or else at a side.
const TurnedWall* findWallOf(const LargeObject& object, const Eigen::AlignedBox3d& body, const std::vector<TurnedWall>& walls) {
  const Eigen::Isometry2d T_map_object = onFloor(object.T_map_object);
  const TurnedWall* found = nullptr;
  double best = 0.0;
  for (const TurnedWall& wall : walls) {
    const Extent extent = extentOf(body, T_map_object, wall.T_map_believed);
    const double front = wall.T_map_believed.linear().col(1).dot(T_map_object.linear().col(0));
    const bool is_parallel = std::max(std::abs(front), std::sqrt(std::max(0.0, 1.0 - front * front))) > kParallelCosine;
    const double rank = (front > kParallelCosine ? 1.0 : 0.0) + kBesideWall_m - std::abs(extent.nearest_m);
    if (is_parallel && isAlong(extent, wall.length_m) && std::abs(extent.nearest_m) < kBesideWall_m && rank > best) {
      best = rank;
      found = &wall;
    }
  }
  return found;
}

}  // namespace

std::vector<TurnedWall> turnedWalls(const std::vector<Eigen::Vector2d>& believed_map, const std::vector<Eigen::Vector2d>& true_map) {
  double twice_area = 0.0;
  for (std::size_t i = 0; i < believed_map.size(); ++i) {
    const Eigen::Vector2d& next = believed_map[(i + 1) % believed_map.size()];
    twice_area += believed_map[i].x() * next.y() - believed_map[i].y() * next.x();
  }
  std::vector<TurnedWall> walls;
  for (std::size_t i = 0; i < believed_map.size(); ++i) {
    const std::size_t next = (i + 1) % believed_map.size();
    TurnedWall wall{frameOf(believed_map[i], believed_map[next], twice_area > 0.0), frameOf(true_map[i], true_map[next], twice_area > 0.0),
                    (believed_map[next] - believed_map[i]).norm()};
    // It turns about where its line has stayed: what its corners slide along it moves nothing.
    const Eigen::Vector2d along = wall.T_map_true.linear().col(0);
    wall.T_map_true.translation() += along * along.dot(wall.T_map_believed.translation() - wall.T_map_true.translation());
    walls.push_back(wall);
  }
  return walls;
}

void followWalls(LargeObject& object, const std::vector<TurnedWall>& walls) {
  const std::optional<Eigen::AlignedBox3d> body = bodyOf(object);
  const TurnedWall* const wall = body ? findWallOf(object, *body, walls) : nullptr;
  if (wall != nullptr) {
    move(object, motionOf(*wall));
  }
}

void followDoorway(LargeObject& door, const std::vector<TurnedWall>& walls) {
  const Eigen::Isometry2d T_map_door = onFloor(door.T_map_object);
  Eigen::Vector2d place_map = Eigen::Vector2d::Zero();
  Eigen::Vector2d forwards_map = Eigen::Vector2d::Zero();
  int count = 0;
  for (const TurnedWall& wall : walls) {
    const Eigen::Vector2d place = wall.T_map_believed.inverse() * T_map_door.translation();
    const bool is_parallel = std::abs(wall.T_map_believed.linear().col(1).dot(T_map_door.linear().col(0))) > kParallelCosine;
    if (is_parallel && std::abs(place.y()) < kBesideWall_m && std::abs(place.x()) < 0.5 * wall.length_m) {
      const Eigen::Isometry2d moved = motionOf(wall) * T_map_door;
      place_map += moved.translation();
      forwards_map += moved.linear().col(0);
      ++count;
    }
  }
  if (count > 0) {
    Eigen::Isometry2d T(Eigen::Rotation2Dd(std::atan2(forwards_map.y(), forwards_map.x())));
    T.translation() = place_map / count;
    move(door, T * T_map_door.inverse());
  }
}

void keepOutOfWalls(LargeObject& object, const LargeObject& believed, const std::vector<TurnedWall>& walls) {
  const std::optional<Eigen::AlignedBox3d> body = bodyOf(object);
  const std::optional<Eigen::AlignedBox3d> believed_body = bodyOf(believed);
  if (!body || !believed_body) {
    return;
  }
  for (const TurnedWall& wall : walls) {
    const Extent was = extentOf(*believed_body, onFloor(believed.T_map_object), wall.T_map_believed);
    const Extent is = extentOf(*body, onFloor(object.T_map_object), wall.T_map_true);
    const double allowed_m = std::min(0.0, was.nearest_m);
    if (isAlong(was, wall.length_m) && was.nearest_m > -kBesideWall_m && is.nearest_m < allowed_m) {
      object.T_map_object.position_m.head<2>() += (allowed_m - is.nearest_m) * wall.T_map_true.linear().col(1);
    }
  }
}

bool hangsOnWall(const LargeObject& object, const std::vector<TurnedWall>& walls) {
  constexpr double kAboveFloor_m = 0.3;
  constexpr double kFlat_m = 0.03;
  const std::optional<Eigen::AlignedBox3d> body = bodyOf(object);
  const TurnedWall* const wall = body ? findWallOf(object, *body, walls) : nullptr;
  return wall != nullptr && object.T_map_object.position_m.z() + body->min().z() > kAboveFloor_m &&
         std::abs(extentOf(*body, onFloor(object.T_map_object), wall->T_map_believed).nearest_m) < kFlat_m;
}

}  // namespace oikos::simulate
