// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/home_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/rfc3339.h"
#include "semantic/query/found_thing.h"

namespace oikos::daemon {

namespace {

using semantic::kRadPerDeg;
using semantic::ThingKind;

/// To the micrometre and the millionth of a degree; no -0.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

Json textOrNull(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json propertiesJson(const std::vector<semantic::Property>& properties) {
  Json json = Json::object();
  for (const semantic::Property& property : properties) {
    json[property.name] = property.value;
  }
  return json;
}

Json graspsJson(const std::vector<semantic::GraspingPoint>& points) {
  Json list = Json::array();
  for (const semantic::GraspingPoint& point : points) {
    list.push_back({{"part", textOrNull(point.part.value)}, {"pose_part", poseJson(point.T_part_grasp.toIsometry())}});
  }
  return list;
}

Json jointJson(const semantic::Joint& joint) {
  const bool turns = joint.type == semantic::JointType::kRevolute;
  const std::string unit = turns ? "_deg" : "_m";
  const double scale = turns ? kRadPerDeg : 1.0;
  return {{"id", joint.id.value},
          {"type", base::toString(joint.type)},
          {"part", joint.child.value},
          {"lower" + unit, rounded(joint.lower / scale)},
          {"upper" + unit, rounded(joint.upper / scale)},
          {"value" + unit, rounded(joint.value / scale)},
          {"open", semantic::isOpen(joint)}};
}

Json knobJson(const semantic::Knob& knob) {
  Json states = Json::array();
  for (const semantic::KnobState& state : knob.states) {
    states.push_back({{"name", state.name}, {"angle_deg", rounded(state.angle_rad / kRadPerDeg)}});
  }
  return {
      {"id", knob.id.value}, {"label", textOrNull(knob.label)}, {"part", knob.part.value}, {"setting", knob.current}, {"states", states}};
}

void addArticulation(Json& json, const semantic::Articulation& articulation) {
  for (const char* const list : {"parts", "joints", "handles", "knobs"}) {
    json[list] = Json::array();
  }
  for (const semantic::Part& part : articulation.parts) {
    json["parts"].push_back({{"id", part.id.value}, {"label", textOrNull(part.label)}, {"parent", textOrNull(part.parent.value)}});
  }
  for (const semantic::Joint& joint : articulation.joints) {
    json["joints"].push_back(jointJson(joint));
  }
  for (const semantic::Handle& handle : articulation.handles) {
    json["handles"].push_back({{"id", handle.id},
                               {"part", handle.part.value},
                               {"kind", base::toString(handle.kind)},
                               {"pose_part", poseJson(handle.T_part_handle.toIsometry())}});
  }
  for (const semantic::Knob& knob : articulation.knobs) {
    json["knobs"].push_back(knobJson(knob));
  }
}

void addFurniture(Json& json, const semantic::LargeObject& object) {
  json["movability"] = base::toString(object.movability);
  json["graspable"] = object.graspable;
  json["model"] = textOrNull(object.model);
  json["affordances"] = object.affordances;
  json["grasping_points"] = graspsJson(object.grasping_points);
  json["small_objects"] = Json::array();
  for (const semantic::SmallObject& small : object.small_objects) {
    json["small_objects"].push_back(small.id.value);
  }
  if (object.articulation) {
    addArticulation(json, *object.articulation);
  }
}

void addSmallObject(Json& json, const semantic::SmallObject& small) {
  json["graspable"] = small.graspable;
  json["model"] = textOrNull(small.model);
  json["default_places"] = Json::array();
  for (const semantic::Placement& place : small.default_places) {
    json["default_places"].push_back({{"parent", place.parent},
                                      {"relation", base::toString(place.relation)},
                                      {"pose_parent", poseJson(place.T_parent_object.toIsometry())}});
  }
  json["grasping_points"] = graspsJson(small.grasping_points);
}

const char* kindName(ThingKind kind) {
  switch (kind) {
    case ThingKind::kRoom:
      return "room";
    case ThingKind::kLargeObject:
      return "furniture";
    case ThingKind::kPart:
      return "part";
    case ThingKind::kKnob:
      return "knob";
    case ThingKind::kSmallObject:
      break;
  }
  return "small_object";
}

}  // namespace

Json poseJson(const Eigen::Isometry3d& T) {
  const semantic::Pose pose = semantic::Pose::fromIsometry(T);
  const Eigen::Vector3d turned_deg = pose.roll_pitch_yaw_rad / kRadPerDeg;
  return {{"x_m", rounded(pose.position_m.x())}, {"y_m", rounded(pose.position_m.y())},  {"z_m", rounded(pose.position_m.z())},
          {"roll_deg", rounded(turned_deg.x())}, {"pitch_deg", rounded(turned_deg.y())}, {"yaw_deg", rounded(turned_deg.z())}};
}

Json roomJson(const semantic::Room& room) {
  Json outline = Json::array();
  for (const Eigen::Vector2d& corner : room.outline_map) {
    outline.push_back({rounded(corner.x()), rounded(corner.y())});
  }
  Json switches = Json::array();
  for (const semantic::Switch& a_switch : room.switches) {
    switches.push_back(
        {{"id", a_switch.id}, {"kind", base::toString(a_switch.kind)}, {"pose_map", poseJson(a_switch.T_map_switch.toIsometry())}});
  }
  std::size_t small_objects = room.small_objects.size();
  for (const auto& object : room.objects) {
    small_objects += object->small_objects.size();
  }
  return {{"id", room.id.value},
          {"kind", "room"},
          {"name", room.name},
          {"type", textOrNull(room.type)},
          {"outline_m", outline},
          {"switches", switches},
          {"furniture", room.objects.size()},
          {"small_objects", small_objects}};
}

Json summaryJson(const semantic::Thing& thing) {
  const semantic::SmallObject* const small = thing.kind == ThingKind::kSmallObject ? thing.small_object : nullptr;
  Json json{{"id", thing.id()},
            {"kind", kindName(thing.kind)},
            {"type", small != nullptr ? small->type : thing.object->type},
            {"name", thing.name()},
            {"room", thing.room->id.value},
            {"parent", small != nullptr ? small->parent : thing.room->id.value},
            {"relation", base::toString(small != nullptr ? small->relation : semantic::Relation::kIn)},
            {"pose_map", poseJson(thing.T_map_thing())}};
  if (small != nullptr) {
    json["properties"] = propertiesJson(small->properties);
    json["last_seen"] = small->last_seen_ns ? Json(base::toRfc3339(*small->last_seen_ns)) : Json();
    json["confidence"] = small->confidence ? Json(*small->confidence) : Json();
  }
  return json;
}

Json thingJson(const semantic::Thing& thing) {
  if (thing.kind == ThingKind::kRoom) {
    return roomJson(*thing.room);
  }
  const semantic::FoundThing found = semantic::describe(thing);
  Json json = thing.kind == ThingKind::kPart || thing.kind == ThingKind::kKnob
                  ? Json{{"id", found.id},     {"kind", kindName(thing.kind)},     {"name", found.name},
                         {"room", found.room}, {"object", thing.object->id.value}, {"pose_map", poseJson(found.T_map_thing)}}
                  : summaryJson(thing);
  json["pose_parent"] = found.T_parent_thing ? poseJson(*found.T_parent_thing) : Json();
  json["parking_poses_map"] = Json::array();
  for (const Eigen::Isometry3d& T_map_base : found.T_map_base) {
    json["parking_poses_map"].push_back(poseJson(T_map_base));
  }
  if (thing.kind == ThingKind::kLargeObject) {
    addFurniture(json, *thing.object);
  } else if (thing.kind == ThingKind::kSmallObject) {
    addSmallObject(json, *thing.small_object);
  } else if (thing.kind == ThingKind::kKnob) {
    json.update(knobJson(*thing.knob));
  }
  for (const semantic::Joint* const joint : semantic::jointsOf(thing)) {
    if (thing.kind == ThingKind::kPart) {
      json["joint"] = jointJson(*joint);
    }
  }
  return json;
}

}  // namespace oikos::daemon
