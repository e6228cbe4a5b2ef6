// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/event_text.h"

#include <cmath>

#include "semantic/query/found_thing.h"
#include "semantic/query/sentence.h"

namespace oikos::semantic {

namespace {

constexpr double kMoved_m = 0.05;
constexpr double kTurned_rad = 5.0 * kRadPerDeg;
constexpr double kSlid_m = 0.02;

bool differ(const Pose& a, const Pose& b) {
  return (a.position_m - b.position_m).norm() > kMoved_m;
}

}  // namespace

const EventTeller::JointPlace* EventTeller::findJoint(const std::string& subject) {
  if (joints_.empty()) {
    for (std::uint32_t i = 0; i < index_.size(); ++i) {
      const Thing& whole = index_.thing(i);
      if (whole.kind != ThingKind::kLargeObject || !whole.object->articulation) {
        continue;
      }
      for (const Joint& joint : whole.object->articulation->joints) {
        const Thing* part = whole.object->type == "door" ? nullptr : index_.findById(joint.child.value);
        joints_[joint.id.value] = {part == nullptr ? &whole : part, &joint};
      }
    }
  }
  const auto found = joints_.find(subject);
  return found == joints_.end() ? nullptr : &found->second;
}

const Thing* EventTeller::thingOf(const std::string& subject) {
  if (const Thing* thing = index_.findById(subject)) {
    return thing;
  }
  const JointPlace* joint = findJoint(subject);
  return joint == nullptr ? nullptr : joint->thing;
}

std::vector<std::string> EventTeller::subjectsOf(const Thing& thing) {
  std::vector<std::string> subjects;
  if (thing.kind != ThingKind::kRoom) {
    subjects.push_back(thing.id());
  }
  for (const Joint* joint : jointsOf(thing)) {
    subjects.push_back(joint->id.value);
  }
  if (thing.kind == ThingKind::kLargeObject) {
    for (const Knob* knob : knobsOf(thing)) {
      subjects.push_back(knob->id.value);
    }
  }
  return subjects;
}

bool EventTeller::isChange(const State& before, const State& after) {
  if (before.index() != after.index()) {
    return true;
  }
  if (const auto* placement = std::get_if<Placement>(&after)) {
    const auto& old = std::get<Placement>(before);
    return old.parent != placement->parent || old.relation != placement->relation ||
           differ(old.T_parent_object, placement->T_parent_object);
  }
  if (const auto* pose = std::get_if<FurniturePose>(&after)) {
    const Pose& old = std::get<FurniturePose>(before).T_map_object;
    const double turned_rad = (old.roll_pitch_yaw_rad - pose->T_map_object.roll_pitch_yaw_rad).cwiseAbs().maxCoeff();
    return differ(old, pose->T_map_object) || turned_rad > kTurned_rad;
  }
  if (const auto* joint = std::get_if<JointValue>(&after)) {
    return std::abs(joint->value - std::get<JointValue>(before).value) > (joint->type == JointType::kRevolute ? kTurned_rad : kSlid_m);
  }
  return before != after;
}

std::optional<bool> EventTeller::isOpenIn(const std::string& subject, const State& state) {
  const auto* const value = std::get_if<JointValue>(&state);
  const JointPlace* const place = value == nullptr ? nullptr : findJoint(subject);
  if (place == nullptr) {
    return std::nullopt;
  }
  Joint joint = *place->joint;
  joint.value = value->value;
  return isOpen(joint);
}

std::string EventTeller::stateText(const std::string& subject, const State& state) {
  if (const auto* setting = std::get_if<KnobSetting>(&state)) {
    return "set to " + setting->state;
  }
  if (const auto* pose = std::get_if<FurniturePose>(&state)) {
    return "at " + positionText(pose->T_map_object.position_m);
  }
  if (const auto* value = std::get_if<JointValue>(&state)) {
    const JointPlace* place = findJoint(subject);
    if (place == nullptr) {
      return "moved";
    }
    Joint joint = *place->joint;
    joint.value = value->value;
    return isOpen(joint) ? "open by " + openingText(joint) : "closed";
  }
  const auto& placement = std::get<Placement>(state);
  const Thing* parent = index_.findById(placement.parent);
  if (parent == nullptr) {
    return "somewhere else";
  }
  Thing carrier = *parent;
  if (carrier.kind == ThingKind::kRoom) {
    return (placement.relation == Relation::kOn ? "on the floor in the " : "in the ") + carrier.name();
  }
  if (carrier.kind == ThingKind::kPart && carrier.part->parent.value.empty()) {
    carrier.kind = ThingKind::kLargeObject;
  }
  return std::string(base::toString(placement.relation)) + " the " + carrier.name() + " in the " + carrier.room->name;
}

}  // namespace oikos::semantic
