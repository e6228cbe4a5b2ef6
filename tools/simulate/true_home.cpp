// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/true_home.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "semantic/model/home_models.h"
#include "tools/simulate/dice.h"
#include "tools/simulate/dressing.h"

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

Pose disturbed(const Pose& pose, double sigma_m, double sigma_deg, Dice& dice) {
  const Eigen::Vector3d axis = Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian()).normalized();
  const double turn_rad = sigma_deg * kRadPerDeg * dice.gaussian();
  Pose made = Pose::fromIsometry(pose.toIsometry() * Eigen::AngleAxisd(turn_rad, axis));
  made.position_m = pose.position_m + sigma_m * Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian());
  return made;
}

/// The true shape's parts, joints, handles and knobs in the states of the believed ones.
void refit(LargeObject& object, const BeliefSettings& belief, Dice& dice) {
  const model::ArticulatedModel shape = makeShape(*object.shape, "shape of '" + object.id.value + "'");
  const Articulation fitted = articulationOf(shape, object.id);
  for (Joint& joint : object.articulation->joints) {
    const auto same =
        std::find_if(fitted.joints.begin(), fitted.joints.end(), [&](const Joint& other) { return other.child == joint.child; });
    if (same == fitted.joints.end()) {
      continue;
    }
    joint.T_parent_joint = disturbed(same->T_parent_joint, belief.axis_m, belief.axis_deg, dice);
    joint.lower = std::min(joint.lower, same->lower);
    joint.upper = std::max(joint.value, same->upper);
  }
  for (Handle& handle : object.articulation->handles) {
    const auto same =
        std::find_if(fitted.handles.begin(), fitted.handles.end(), [&](const Handle& other) { return other.id == handle.id; });
    handle.T_part_handle = same == fitted.handles.end() ? handle.T_part_handle : same->T_part_handle;
  }
  for (Knob& knob : object.articulation->knobs) {
    const auto same = std::find_if(fitted.knobs.begin(), fitted.knobs.end(), [&](const Knob& other) { return other.id == knob.id; });
    knob.T_part_knob = same == fitted.knobs.end() ? knob.T_part_knob : same->T_part_knob;
  }
}

void disturb(LargeObject& object, const BeliefSettings& belief, Dice& dice) {
  if (object.shape) {
    remeasure(object.shape->edit(), belief.dimension_m, dice);
    if (object.articulation) {
      refit(object, belief, dice);
    }
  }
  object.T_map_object.position_m.head<2>() += belief.placement_m * Eigen::Vector2d(dice.gaussian(), dice.gaussian());
  object.T_map_object.roll_pitch_yaw_rad.z() += belief.placement_deg * kRadPerDeg * dice.gaussian();
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
  for (Room& room : home.rooms) {
    Dice walls(seed + hashOf(room.id.value));
    tiltWalls(room, belief.wall_deg, walls);
    for (CopyOnWrite<LargeObject>& object : room.objects) {
      Dice dice(seed + hashOf(object->id.value));
      disturb(object.edit(), belief, dice);
    }
  }
  return home;
}

}  // namespace oikos::simulate
