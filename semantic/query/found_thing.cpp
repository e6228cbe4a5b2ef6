// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/found_thing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "semantic/model/placement.h"

namespace oikos::semantic {

namespace {

/// A thing as near as this to two doors may be behind either.
constexpr double kEquallyNear_m = 0.05;

JointReading readingOf(const Joint& joint) {
  return {joint.id.value, joint.type, joint.value};
}

Eigen::Isometry3d partInMap(const LargeObject& object, const std::string& part) {
  return findCarrierInMap(object, part).value_or(object.T_map_object.toIsometry());
}

std::vector<Eigen::Isometry3d> parkingInMap(const LargeObject& object, const std::optional<RobotPlace>& robot) {
  std::vector<ParkingPose> parking = object.parking_poses;
  std::stable_partition(parking.begin(), parking.end(), [](const ParkingPose& pose) { return pose.is_default; });
  std::vector<Eigen::Isometry3d> T_map_base;
  for (const ParkingPose& pose : parking) {
    T_map_base.push_back(object.T_map_object.toIsometry() * pose.T_object_base.toIsometry());
  }
  if (robot) {
    const auto distance = [&](const Eigen::Isometry3d& T) { return (T.translation().head<2>() - robot->position_map_m).norm(); };
    std::stable_sort(T_map_base.begin(), T_map_base.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  }
  return T_map_base;
}

std::vector<Eigen::Isometry3d> graspsInMap(const Thing& thing) {
  std::vector<Eigen::Isometry3d> T_map_grasp;
  if (thing.kind == ThingKind::kSmallObject) {
    for (const GraspingPoint& point : thing.small_object->grasping_points) {
      T_map_grasp.push_back(thing.T_map_thing() * point.T_part_grasp.toIsometry());
    }
  } else if (thing.kind == ThingKind::kLargeObject || thing.kind == ThingKind::kPart) {
    for (const GraspingPoint& point : thing.object->grasping_points) {
      if (thing.part == nullptr || point.part == thing.part->id) {
        T_map_grasp.push_back(partInMap(*thing.object, point.part.value) * point.T_part_grasp.toIsometry());
      }
    }
  }
  return T_map_grasp;
}

void describePlace(const Thing& thing, FoundThing& found) {
  switch (thing.kind) {
    case ThingKind::kRoom:
      return;
    case ThingKind::kLargeObject:
      found.type = thing.object->type;
      found.parent = thing.room->id.value;
      return;
    case ThingKind::kPart:
    case ThingKind::kKnob:
      found.parent = thing.object->id.value;
      return;
    case ThingKind::kSmallObject:
      break;
  }
  const SmallObject& small = *thing.small_object;
  found.type = small.type;
  found.parent = small.parent;
  found.relation = small.relation;
  found.T_parent_thing = small.T_parent_object.toIsometry();
  found.usual_places = small.default_places;
  found.last_seen_ns = small.last_seen_ns;
}

std::vector<const Joint*> jointsOfPart(const LargeObject& object, const PartId& part) {
  std::vector<const Joint*> joints;
  for (const Joint& joint : object.articulation->joints) {
    if (joint.child == part) {
      joints.push_back(&joint);
    }
  }
  return joints;
}

/// The middle of a shut door, in its object: between its hinge and its handle, as far as they are known.
Eigen::Vector3d middleOfShutDoor(const LargeObject& object, const Joint& door) {
  const Eigen::Isometry3d T_object_door =
      findPartInObject(*object.articulation, door.parent).value_or(Eigen::Isometry3d::Identity()) * door.T_parent_joint.toIsometry();
  const auto& handles = object.articulation->handles;
  const auto handle = std::find_if(handles.begin(), handles.end(), [&](const Handle& h) { return h.part == door.child; });
  return handle == handles.end() ? Eigen::Vector3d(T_object_door.translation())
                                 : T_object_door * Eigen::Vector3d(0.5 * handle->T_part_handle.toIsometry().translation());
}

/// What lies in the body may be behind a door, not behind a drawer: behind the door that is nearest, several where they are equally near.
std::vector<const Joint*> doorsNearestTo(const Thing& thing) {
  const Eigen::Vector3d at_object = thing.object->T_map_object.toIsometry().inverse() * thing.T_map_thing().translation();
  std::vector<std::pair<double, const Joint*>> doors;  // how far off its middle is
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Joint& joint : thing.object->articulation->joints) {
    if (joint.type == JointType::kRevolute) {
      doors.emplace_back((middleOfShutDoor(*thing.object, joint) - at_object).norm(), &joint);
      nearest_m = std::min(nearest_m, doors.back().first);
    }
  }
  std::vector<const Joint*> nearest;
  for (const auto& [away_m, door] : doors) {
    if (away_m <= nearest_m + kEquallyNear_m) {
      nearest.push_back(door);
    }
  }
  return nearest;
}

}  // namespace

std::vector<const Joint*> jointsInTheWay(const Thing& thing) {
  if (thing.kind != ThingKind::kSmallObject || thing.object == nullptr || !thing.object->articulation ||
      thing.small_object->relation != Relation::kIn) {
    return {};
  }
  const bool in_base = thing.part == nullptr || thing.part->parent.value.empty();
  std::vector<const Joint*> joints = in_base ? doorsNearestTo(thing) : jointsOfPart(*thing.object, thing.part->id);
  std::erase_if(joints, [](const Joint* joint) { return isOpen(*joint); });
  return joints;
}

std::vector<const Joint*> jointsOf(const Thing& thing) {
  std::vector<const Joint*> joints;
  if (thing.object == nullptr || !thing.object->articulation || thing.kind == ThingKind::kSmallObject || thing.kind == ThingKind::kKnob) {
    return joints;
  }
  for (const Joint& joint : thing.object->articulation->joints) {
    if (thing.part == nullptr || joint.child == thing.part->id) {
      joints.push_back(&joint);
    }
  }
  return joints;
}

std::vector<const Knob*> knobsOf(const Thing& thing) {
  std::vector<const Knob*> knobs;
  if (thing.kind == ThingKind::kKnob) {
    knobs.push_back(thing.knob);
  } else if ((thing.kind == ThingKind::kLargeObject || thing.kind == ThingKind::kPart) && thing.object->articulation) {
    for (const Knob& knob : thing.object->articulation->knobs) {
      if (thing.part == nullptr || knob.part == thing.part->id) {
        knobs.push_back(&knob);
      }
    }
  }
  return knobs;
}

std::vector<HandlePlace> handlesOf(const LargeObject& object, const Joint& joint) {
  std::vector<HandlePlace> handles;
  for (const Handle& handle : object.articulation->handles) {
    if (handle.part == joint.child) {
      handles.push_back({handle.id, handle.kind, partInMap(object, handle.part.value) * handle.T_part_handle.toIsometry()});
    }
  }
  return handles;
}

double openingOf(const Joint& joint) {
  const double shut = std::clamp(0.0, std::min(joint.lower, joint.upper), std::max(joint.lower, joint.upper));
  return std::abs(joint.value - shut);
}

bool isOpen(const Joint& joint) {
  return openingOf(joint) > (joint.type == JointType::kRevolute ? 5.0 * kRadPerDeg : 0.02);
}

std::optional<bool> isOpen(const Thing& thing) {
  const std::vector<const Joint*> joints = jointsOf(thing);
  if (joints.empty()) {
    return std::nullopt;
  }
  return std::any_of(joints.begin(), joints.end(), [](const Joint* joint) { return isOpen(*joint); });
}

FoundThing describe(const Thing& thing, const std::optional<RobotPlace>& robot) {
  FoundThing found;
  found.id = thing.id();
  found.name = thing.name();
  found.room = thing.room->id.value;
  found.T_map_thing = thing.T_map_thing();
  describePlace(thing, found);
  if (thing.object != nullptr) {
    found.T_map_base = parkingInMap(*thing.object, robot);
  }
  for (const Joint* joint : jointsInTheWay(thing)) {
    found.joints_to_move.push_back(readingOf(*joint));
  }
  for (const Joint* joint : jointsOf(thing)) {
    found.joints.push_back(readingOf(*joint));
    const std::vector<HandlePlace> handles = handlesOf(*thing.object, *joint);
    found.handles.insert(found.handles.end(), handles.begin(), handles.end());
  }
  found.T_map_grasp = graspsInMap(thing);
  found.setting = thing.kind == ThingKind::kKnob ? thing.knob->current : "";
  return found;
}

}  // namespace oikos::semantic
