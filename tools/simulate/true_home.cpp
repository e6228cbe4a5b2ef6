// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/true_home.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "semantic/model/home_models.h"
#include "tools/simulate/dice.h"
#include "tools/simulate/dressing.h"
#include "tools/simulate/turned_walls.h"

namespace oikos::simulate {

namespace {

using namespace semantic;

/// Outer dimensions, as a tape measures them; thicknesses and gaps are the maker's and stay.
bool isMeasured(const std::string& name) {
  return name == "width_m" || name == "depth_m" || name == "height_m";
}

/// Every outer dimension that the shape names is a little off.
void remeasure(Shape& shape, double sigma_m, Dice& dice) {
  for (Property& dimension : shape.dimensions) {
    const std::optional<double> value = isMeasured(dimension.name) ? base::findNumber(dimension.value) : std::nullopt;
    if (value) {
      const double error_m = std::clamp(sigma_m * dice.gaussian(), -0.3 * *value, 0.3 * *value);
      dimension.value = base::toText(std::round((*value + error_m) * 1e5) / 1e5);
    }
  }
}

void disturbAxis(Joint& joint, double sigma_m, double sigma_deg, Dice& dice) {
  const Eigen::Vector3d axis = Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian()).normalized();
  const double turn_rad = sigma_deg * kRadPerDeg * dice.gaussian();
  Pose& pose = joint.T_parent_joint;
  if (turn_rad != 0.0) {
    pose.roll_pitch_yaw_rad = Pose::fromIsometry(pose.toIsometry() * Eigen::AngleAxisd(turn_rad, axis)).roll_pitch_yaw_rad;
  }
  pose.position_m += sigma_m * Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian());
}

/// The entries of two lists that are the same thing in two shapes; calls `move(entry, before, after)`.
template <class Entry, class Move>
void moveAlong(std::vector<Entry>& entries, const std::vector<Entry>& before, const std::vector<Entry>& after, const Move& move) {
  const auto findIn = [](const std::vector<Entry>& list, const Entry& wanted) {
    return std::find_if(list.begin(), list.end(), [&](const Entry& other) {
      if constexpr (std::is_same_v<Entry, Joint>) {
        return other.child == wanted.child;
      } else {
        return other.id == wanted.id;
      }
    });
  };
  for (Entry& entry : entries) {
    const auto was = findIn(before, entry);
    const auto is = findIn(after, entry);
    if (was != before.end() && is != after.end()) {
      move(entry, *was, *is);
    }
  }
}

/// Moves joints, handles and knobs by as much as the true dimensions move the shape's; what the home says otherwise stays.
void refit(LargeObject& object, const Shape& believed) {
  const std::string where = "shape of '" + object.id.value + "'";
  const Articulation before = articulationOf(makeShape(believed, where), object.id);
  const Articulation after = articulationOf(makeShape(*object.shape, where), object.id);
  Articulation& fitted = *object.articulation;
  moveAlong(fitted.joints, before.joints, after.joints, [](Joint& joint, const Joint& was, const Joint& is) {
    joint.T_parent_joint.position_m += is.T_parent_joint.position_m - was.T_parent_joint.position_m;
    joint.lower = std::min(joint.value, joint.lower + (is.lower - was.lower));
    joint.upper = std::max(joint.value, joint.upper + (is.upper - was.upper));
  });
  moveAlong(fitted.handles, before.handles, after.handles, [](Handle& handle, const Handle& was, const Handle& is) {
    handle.T_part_handle.position_m += is.T_part_handle.position_m - was.T_part_handle.position_m;
  });
  moveAlong(fitted.knobs, before.knobs, after.knobs, [](Knob& knob, const Knob& was, const Knob& is) {
    knob.T_part_knob.position_m += is.T_part_knob.position_m - was.T_part_knob.position_m;
  });
}

double heightOf(const Shape& shape) {
  const auto found = std::find_if(shape.dimensions.begin(), shape.dimensions.end(), [](const Property& p) { return p.name == "height_m"; });
  return found == shape.dimensions.end() ? 0.0 : base::findNumber(found->value).value_or(0.0);
}

/// What stands on top of the piece neither floats nor sinks in.
void raiseWhatStandsOn(LargeObject& object, const Shape& believed) {
  constexpr double kOnTop_m = 0.02;
  const double height_m = heightOf(believed);
  for (SmallObject& small : object.small_objects) {
    double& z_m = small.T_parent_object.position_m.z();
    if (small.parent == object.id.value && small.relation == Relation::kOn && std::abs(z_m - height_m) < kOnTop_m) {
      z_m += heightOf(*object.shape) - height_m;
    }
  }
}

/// Its place on the floor; what is fixed to a wall stays in that wall's plane.
void displace(LargeObject& object, const BeliefSettings& belief, bool is_in_wall, Dice& dice) {
  Eigen::Vector2d shift_m = belief.placement_m * Eigen::Vector2d(dice.gaussian(), dice.gaussian());
  double turn_rad = belief.placement_deg * kRadPerDeg * dice.gaussian();
  if (is_in_wall) {
    const double yaw_rad = object.T_map_object.roll_pitch_yaw_rad.z();
    const Eigen::Vector2d along(-std::sin(yaw_rad), std::cos(yaw_rad));
    shift_m = along * along.dot(shift_m);
    turn_rad = 0.0;
  }
  object.T_map_object.position_m.head<2>() += shift_m;
  object.T_map_object.roll_pitch_yaw_rad.z() += turn_rad;
}

/// The walls of the home, and of the room that a piece stands in.
struct Walls {
  const std::vector<TurnedWall>& of_home;
  const std::vector<TurnedWall>& of_room;
};

void disturb(LargeObject& object, const BeliefSettings& belief, const Walls& walls, Dice& dice) {
  const LargeObject believed = object;
  const bool is_door = object.type == "door";
  const bool is_in_wall = is_door || hangsOnWall(object, walls.of_room);
  if (belief.wall_deg > 0.0) {
    is_door ? followDoorway(object, walls.of_home) : followWalls(object, walls.of_room);
  }
  if (object.shape && belief.dimension_m > 0.0) {
    const Shape believed_shape = **object.shape;
    remeasure(object.shape->edit(), belief.dimension_m, dice);
    if (object.articulation) {
      refit(object, believed_shape);
    }
    raiseWhatStandsOn(object, believed_shape);
  }
  if (object.articulation) {
    for (Joint& joint : object.articulation->joints) {
      disturbAxis(joint, belief.axis_m, belief.axis_deg, dice);
    }
  }
  displace(object, belief, is_in_wall, dice);
  if (!is_door) {
    keepOutOfWalls(object, believed, walls.of_room);
  }
}

/// Each wall turns a little about its middle; corners are where the turned walls meet.
void tiltWalls(Room& room, double sigma_deg, Dice& dice) {
  const std::vector<Eigen::Vector2d> corners = room.outline_map;
  const std::size_t count = corners.size();
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls;  // a point and a direction
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& next = corners[(i + 1) % count];
    walls.emplace_back(0.5 * (corners[i] + next),
                       Eigen::Rotation2Dd(sigma_deg * kRadPerDeg * dice.gaussian()) * (next - corners[i]).normalized());
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [p, d] = walls[(i + count - 1) % count];
    const auto& [q, e] = walls[i];
    const double determinant = d.x() * e.y() - d.y() * e.x();
    if (std::abs(determinant) > 0.1) {
      const Eigen::Vector2d between = q - p;
      room.outline_map[i] = p + d * ((between.x() * e.y() - between.y() * e.x()) / determinant);
    }
  }
}

}  // namespace

Home makeTrueHome(const Home& believed, const BeliefSettings& belief, std::uint64_t seed) {
  Home home = believed;
  std::vector<std::vector<TurnedWall>> of_rooms;
  std::vector<TurnedWall> of_home;
  for (Room& room : home.rooms) {
    const std::vector<Eigen::Vector2d> outline_map = room.outline_map;
    if (belief.wall_deg > 0.0) {
      Dice dice(seed + hashOf(room.id.value));
      tiltWalls(room, belief.wall_deg, dice);
    }
    of_rooms.push_back(turnedWalls(outline_map, room.outline_map));
    of_home.insert(of_home.end(), of_rooms.back().begin(), of_rooms.back().end());
  }
  for (std::size_t i = 0; i < home.rooms.size(); ++i) {
    for (CopyOnWrite<LargeObject>& object : home.rooms[i].objects) {
      Dice dice(seed + hashOf(object->id.value));
      disturb(object.edit(), belief, {of_home, of_rooms[i]}, dice);
    }
  }
  return home;
}

}  // namespace oikos::simulate
