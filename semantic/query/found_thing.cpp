// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/found_thing.h"

#include <algorithm>
#include <cmath>

namespace oikos::semantic {

namespace {

JointReading readingOf(const Joint& joint) {
  return {joint.id.value, joint.type, joint.value};
}

/// What stands between the robot and a small object: the shut joints of its drawer; in a body with doors, all that are shut.
std::vector<JointReading> jointsToMove(const Thing& thing) {
  std::vector<JointReading> joints;
  if (thing.kind != ThingKind::kSmallObject || thing.object == nullptr || !thing.object->articulation ||
      thing.small_object->relation != Relation::kIn) {
    return joints;
  }
  const bool in_base = thing.part == nullptr || thing.part->parent.value.empty();
  for (const Joint& joint : thing.object->articulation->joints) {
    if (!isOpen(joint) && (in_base || joint.child == thing.part->id)) {
      joints.push_back(readingOf(joint));
    }
  }
  return joints;
}

}  // namespace

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

double openingOf(const Joint& joint) {
  const double shut = std::clamp(0.0, std::min(joint.lower, joint.upper), std::max(joint.lower, joint.upper));
  return std::abs(joint.value - shut);
}

bool isOpen(const Joint& joint) {
  return openingOf(joint) > (joint.type == JointType::kRevolute ? 5.0 * kRadPerDeg : 0.02);
}

FoundThing describe(const Thing& thing) {
  FoundThing found;
  found.id = thing.id();
  found.name = thing.name();
  found.room = thing.room->id.value;
  found.T_map_thing = thing.T_map_thing();
  if (thing.kind == ThingKind::kSmallObject) {
    found.parent = thing.small_object->parent;
    found.relation = thing.small_object->relation;
    found.T_parent_thing = thing.small_object->T_parent_object.toIsometry();
    found.last_seen_ns = thing.small_object->last_seen_ns;
    found.confidence = thing.small_object->confidence;
  } else if (thing.kind == ThingKind::kPart || thing.kind == ThingKind::kKnob) {
    found.parent = thing.object->id.value;
  } else if (thing.kind == ThingKind::kLargeObject) {
    found.parent = thing.room->id.value;
  }
  if (thing.object != nullptr) {
    std::vector<ParkingPose> parking = thing.object->parking_poses;
    std::stable_partition(parking.begin(), parking.end(), [](const ParkingPose& pose) { return pose.is_default; });
    for (const ParkingPose& pose : parking) {
      found.T_map_base.push_back(thing.object->T_map_object.toIsometry() * pose.T_object_base.toIsometry());
    }
  }
  found.joints_to_move = jointsToMove(thing);
  for (const Joint* joint : jointsOf(thing)) {
    found.joints.push_back(readingOf(*joint));
  }
  found.setting = thing.kind == ThingKind::kKnob ? thing.knob->current : "";
  return found;
}

}  // namespace oikos::semantic
