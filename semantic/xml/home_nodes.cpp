// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_nodes.h"

#include <algorithm>

#include "core/base/degrees.h"
#include "core/base/enum_table.h"
#include "core/base/number_text.h"
#include "core/base/rfc3339.h"

namespace oikos::semantic {

namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

std::string numberText(double value) {
  return base::toText(value + 0.0);  // no -0
}

std::string degreesText(double rad) {
  return base::toText(base::toDegrees(rad));
}

std::string vectorText(const Eigen::Vector3d& v) {
  return numberText(v.x()) + " " + numberText(v.y()) + " " + numberText(v.z());
}

std::string poseText(const Pose& pose) {
  const Eigen::Vector3d& angles = pose.roll_pitch_yaw_rad;
  return vectorText(pose.position_m) + " " + degreesText(angles.x()) + " " + degreesText(angles.y()) + " " + degreesText(angles.z());
}

std::string flagText(bool flag) {
  return flag ? "true" : "false";
}

/// Left out where it is empty.
void addText(Attributes& attributes, const char* name, const std::string& text) {
  if (!text.empty()) {
    attributes.emplace_back(name, text);
  }
}

XmlNode leaf(const char* name, Attributes attributes) {
  XmlNode node;
  node.name = name;
  node.attributes = std::move(attributes);
  return node;
}

XmlNode identified(const char* name, const std::string& id) {
  XmlNode node = leaf(name, {{"id", id}});
  node.id = id;
  return node;
}

XmlNode boxNode(const Box& box) {
  return leaf("box", {{"center", poseText(box.center)}, {"size_m", vectorText(box.size_m)}});
}

XmlNode shapeNode(const Shape& shape) {
  XmlNode node = leaf("shape", {{"kind", shape.kind}});
  node.whole = true;  // the dimensions keep their order
  for (const Property& dimension : shape.dimensions) {
    node.attributes.emplace_back(dimension.name, dimension.value);
  }
  return node;
}

XmlNode graspNode(const GraspingPoint& point) {
  XmlNode node = leaf("graspingPoint", {});
  addText(node.attributes, "part", point.part.value);
  node.attributes.emplace_back("pose", poseText(point.T_part_grasp));
  return node;
}

template <class Source>
XmlNode unwritten(const char* name, const Source& source) {
  XmlNode node;
  node.name = name;
  node.id = source.id.value;
  node.source = &source;
  return node;
}

XmlNode partNode(const Part& part) {
  XmlNode node = identified("part", part.id.value);
  addText(node.attributes, "label", part.label);
  addText(node.attributes, "parent", part.parent.value);
  addText(node.attributes, "model", part.model);
  for (const Box& box : part.boxes_part) {
    node.children.push_back(boxNode(box));
  }
  return node;
}

XmlNode jointNode(const Joint& joint) {
  const bool turns = joint.type == JointType::kRevolute;
  const auto inUnit = [&](double value) { return turns ? degreesText(value) : numberText(value); };
  XmlNode node = identified("joint", joint.id.value);
  const Attributes rest{{"type", std::string(base::toString(joint.type))},
                        {"parent", joint.parent.value},
                        {"child", joint.child.value},
                        {"origin", poseText(joint.T_parent_joint)},
                        {"axis", vectorText(joint.axis_joint)},
                        {turns ? "lower_deg" : "lower_m", inUnit(joint.lower)},
                        {turns ? "upper_deg" : "upper_m", inUnit(joint.upper)},
                        {turns ? "value_deg" : "value_m", inUnit(joint.value)}};
  node.attributes.insert(node.attributes.end(), rest.begin(), rest.end());
  return node;
}

XmlNode handleNode(const Handle& handle) {
  XmlNode node = identified("handle", handle.id);
  node.attributes.emplace_back("part", handle.part.value);
  node.attributes.emplace_back("kind", base::toString(handle.kind));
  node.attributes.emplace_back("pose", poseText(handle.T_part_handle));
  if (handle.length_m) {
    node.attributes.emplace_back("length_m", numberText(*handle.length_m));
  }
  return node;
}

XmlNode knobNode(const Knob& knob) {
  XmlNode node = identified("knob", knob.id.value);
  addText(node.attributes, "label", knob.label);
  node.attributes.emplace_back("part", knob.part.value);
  node.attributes.emplace_back("pose", poseText(knob.T_part_knob));
  node.attributes.emplace_back("axis", vectorText(knob.axis_knob));
  node.attributes.emplace_back("current", knob.current);
  for (const KnobState& state : knob.states) {
    node.children.push_back(leaf("state", {{"name", state.name}, {"angle_deg", degreesText(state.angle_rad)}}));
  }
  return node;
}

XmlNode switchNode(const Switch& light_switch) {
  XmlNode node = identified("switch", light_switch.id);
  node.attributes.emplace_back("kind", base::toString(light_switch.kind));
  node.attributes.emplace_back("pose", poseText(light_switch.T_map_switch));
  return node;
}

void write(const SmallObject& object, XmlNode& node) {
  Attributes& a = node.attributes;
  a = {{"id", object.id.value}, {"type", object.type}};
  addText(a, "label", object.label);
  a.emplace_back("parent", object.parent);
  a.emplace_back("relation", base::toString(object.relation));
  a.emplace_back("pose", poseText(object.T_parent_object));
  addText(a, "model", object.model);
  a.emplace_back("graspable", flagText(object.graspable));
  if (object.last_seen_ns) {
    a.emplace_back("lastSeen", base::toRfc3339(*object.last_seen_ns));
  }
  if (object.confidence) {
    a.emplace_back("confidence", numberText(*object.confidence));
  }
  if (object.grasp.surface_normal_map) {
    a.emplace_back("surfaceNormal", vectorText(*object.grasp.surface_normal_map));
  }
  if (object.grasp.longer_dimension_m) {
    a.emplace_back("longerDimension_m", numberText(*object.grasp.longer_dimension_m));
  }
  for (const Property& property : object.properties) {
    node.children.push_back(leaf("property", {{"name", property.name}, {"value", property.value}}));
  }
  for (const Placement& place : object.default_places) {
    node.children.push_back(leaf(
        "defaultPlace",
        {{"parent", place.parent}, {"relation", std::string(base::toString(place.relation))}, {"pose", poseText(place.T_parent_object)}}));
  }
  for (const GraspingPoint& point : object.grasping_points) {
    node.children.push_back(graspNode(point));
  }
  for (const Eigen::Vector3d& axis : object.grasp.symmetry_axes_model) {
    node.children.push_back(leaf("symmetryAxis", {{"direction", vectorText(axis)}}));
  }
  if (object.shape) {
    node.children.push_back(shapeNode(*object.shape));
  }
  if (object.box_model) {
    node.children.push_back(boxNode(*object.box_model));
  }
}

void write(const Articulation& articulation, XmlNode& node) {
  std::transform(articulation.parts.begin(), articulation.parts.end(), std::back_inserter(node.children), partNode);
  std::transform(articulation.joints.begin(), articulation.joints.end(), std::back_inserter(node.children), jointNode);
  std::transform(articulation.handles.begin(), articulation.handles.end(), std::back_inserter(node.children), handleNode);
  std::transform(articulation.knobs.begin(), articulation.knobs.end(), std::back_inserter(node.children), knobNode);
}

void write(const LargeObject& object, XmlNode& node) {
  Attributes& a = node.attributes;
  a = {{"id", object.id.value}, {"type", object.type}};
  addText(a, "label", object.label);
  a.emplace_back("pose", poseText(object.T_map_object));
  addText(a, "model", object.model);
  a.emplace_back("movability", base::toString(object.movability));
  a.emplace_back("graspable", flagText(object.graspable));
  if (object.shape) {
    node.children.push_back(shapeNode(*object.shape));
  }
  std::transform(object.boxes_object.begin(), object.boxes_object.end(), std::back_inserter(node.children), boxNode);
  if (object.articulation) {
    write(*object.articulation, node);
  }
  std::transform(object.grasping_points.begin(), object.grasping_points.end(), std::back_inserter(node.children), graspNode);
  for (const std::string& affordance : object.affordances) {
    node.children.push_back(leaf("affordance", {{"name", affordance}}));
  }
  for (const ParkingPose& parking : object.parking_poses) {
    node.children.push_back(leaf("parkingPose", {{"pose", poseText(parking.T_object_base)}}));
    if (parking.is_default) {
      node.children.back().attributes.emplace_back("default", "true");
    }
  }
  for (const SmallObject& small : object.small_objects) {
    node.children.push_back(unwritten("smallObject", small));
  }
}

void write(const Room& room, XmlNode& node) {
  Attributes& a = node.attributes;
  a = {{"id", room.id.value}, {"name", room.name}};
  addText(a, "type", room.type);
  std::string outline;
  for (const Eigen::Vector2d& corner : room.outline_map) {
    outline += (outline.empty() ? "" : " ") + numberText(corner.x()) + " " + numberText(corner.y());
  }
  addText(a, "outline_m", outline);
  addText(a, "cloud", room.cloud);
  std::transform(room.switches.begin(), room.switches.end(), std::back_inserter(node.children), switchNode);
  for (const LargeObject& object : room.objects) {
    node.children.push_back(unwritten(object.articulation ? "largeArticulatedObject" : "largeObject", object));
  }
  for (const SmallObject& small : room.small_objects) {
    node.children.push_back(unwritten("smallObject", small));
  }
}

/// The terms that the built-in vocabulary lacks, with the synonyms and times that it lacks.
XmlNode vocabularyNode(const Vocabulary& vocabulary) {
  static const Vocabulary built_in = builtInVocabulary();
  XmlNode node = leaf("vocabulary", {});
  node.whole = true;
  for (const auto& [kind, kind_name] : enumTable(TermKind{})) {
    for (const Term& term : vocabulary.of(kind)) {
      const auto& known_terms = built_in.of(kind);
      const auto known = std::find_if(known_terms.begin(), known_terms.end(), [&](const Term& t) { return t.name == term.name; });
      XmlNode term_node = leaf("term", {{"kind", std::string(kind_name)}, {"name", term.name}});
      for (const std::string& synonym : term.synonyms) {
        if (known == known_terms.end() || std::find(known->synonyms.begin(), known->synonyms.end(), synonym) == known->synonyms.end()) {
          term_node.children.push_back(leaf("synonym", {}));
          term_node.children.back().text = synonym;
        }
      }
      const bool stays_otherwise = term.stays_for_h && (known == known_terms.end() || known->stays_for_h != term.stays_for_h);
      if (stays_otherwise) {
        term_node.attributes.emplace_back("staysFor_h", numberText(*term.stays_for_h));
      }
      if (known == known_terms.end() || stays_otherwise || !term_node.children.empty()) {
        node.children.push_back(std::move(term_node));
      }
    }
  }
  return node;
}

}  // namespace

XmlNode nodeOf(const Home& home, const WrittenAnyway& anyway) {
  XmlNode node = leaf("apartment", {{"id", home.id}, {"name", home.name}, {"version", std::to_string(home.version)}});
  if (home.time_zone != "UTC") {
    node.attributes.emplace_back("timeZone", home.time_zone);
  }
  if (home.as_of != 0) {
    node.attributes.emplace_back("asOf", std::to_string(home.as_of));
  }
  if (anyway.dock || !(home.T_map_dock == Pose{})) {
    node.children.push_back(leaf("dock", {{"pose", poseText(home.T_map_dock)}}));
  }
  XmlNode vocabulary = vocabularyNode(*home.vocabulary);
  if (anyway.vocabulary || !vocabulary.children.empty()) {
    node.children.push_back(std::move(vocabulary));
  }
  for (const Room& room : home.rooms) {
    node.children.push_back(unwritten("room", room));
  }
  return node;
}

void writeOut(XmlNode& node) {
  if (const auto* const room = std::get_if<const Room*>(&node.source)) {
    write(**room, node);
  } else if (const auto* const object = std::get_if<const LargeObject*>(&node.source)) {
    write(**object, node);
  } else if (const auto* const small = std::get_if<const SmallObject*>(&node.source)) {
    write(**small, node);
  }
  node.source = std::monostate();
}

bool isSame(const XmlNode& a, const XmlNode& b) {
  const auto* const room = std::get_if<const Room*>(&a.source);
  const auto* const object = std::get_if<const LargeObject*>(&a.source);
  const auto* const small = std::get_if<const SmallObject*>(&a.source);
  if (a.source.index() != b.source.index()) {
    return false;
  }
  if (room != nullptr) {
    return **room == *std::get<const Room*>(b.source);
  }
  if (object != nullptr) {
    return **object == *std::get<const LargeObject*>(b.source);
  }
  if (small != nullptr) {
    return **small == *std::get<const SmallObject*>(b.source);
  }
  return a.name == b.name && a.text == b.text && a.attributes == b.attributes &&
         std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(), isSame);
}

}  // namespace oikos::semantic
