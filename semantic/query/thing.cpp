// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/thing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semantic/model/placement.h"
#include "semantic/model/relations.h"

namespace oikos::semantic {

namespace {

std::string labelled(const std::string& label, const std::string& otherwise) {
  return label.empty() ? spaced(otherwise) : label;
}

std::string nameOf(const SmallObject& object) {
  if (!object.label.empty()) {
    return object.label;
  }
  const auto color =
      std::find_if(object.properties.begin(), object.properties.end(), [](const Property& property) { return property.name == "color"; });
  return (color == object.properties.end() ? "" : spaced(color->value) + " ") + spaced(object.type);
}

Eigen::Isometry3d carrierInMap(const Thing& thing, const std::string& carrier) {
  return findCarrierInMap(*thing.object, carrier).value_or(thing.object->T_map_object.toIsometry());
}

}  // namespace

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

const std::string& Thing::id() const {
  switch (kind) {
    case ThingKind::kRoom:
      return room->id.value;
    case ThingKind::kLargeObject:
      return object->id.value;
    case ThingKind::kPart:
      return part->id.value;
    case ThingKind::kKnob:
      return knob->id.value;
    case ThingKind::kSmallObject:
      break;
  }
  return small_object->id.value;
}

std::string Thing::name() const {
  switch (kind) {
    case ThingKind::kRoom:
      return room->name;
    case ThingKind::kLargeObject:
      return labelled(object->label, object->type);
    case ThingKind::kPart:
      return labelled(part->label, part->id.value) + " of the " + labelled(object->label, object->type);
    case ThingKind::kKnob:
      return labelled(knob->label, knob->id.value) + " of the " + labelled(object->label, object->type);
    case ThingKind::kSmallObject:
      break;
  }
  return nameOf(*small_object);
}

Eigen::Isometry3d Thing::T_map_thing() const {
  switch (kind) {
    case ThingKind::kRoom:
      return Eigen::Isometry3d::Identity();
    case ThingKind::kLargeObject:
      return object->T_map_object.toIsometry();
    case ThingKind::kPart:
      return carrierInMap(*this, part->id.value);
    case ThingKind::kKnob:
      return carrierInMap(*this, knob->part.value) * knob->T_part_knob.toIsometry();
    case ThingKind::kSmallObject:
      break;
  }
  const Eigen::Isometry3d T_map_parent = object == nullptr ? Eigen::Isometry3d::Identity() : carrierInMap(*this, small_object->parent);
  return T_map_parent * small_object->T_parent_object.toIsometry();
}

std::vector<Box> Thing::boxes_map() const {
  std::vector<Box> boxes;
  if (kind == ThingKind::kLargeObject || kind == ThingKind::kPart) {
    boxes = boxesOf(*object, id());
  } else if (kind == ThingKind::kSmallObject && small_object->box_model) {
    boxes.push_back(*small_object->box_model);
  }
  const Eigen::Isometry3d T_map = T_map_thing();
  for (Box& box : boxes) {
    box.center = Pose::fromIsometry(T_map * box.center.toIsometry());
  }
  return boxes;
}

Eigen::Vector3d Thing::middle_map() const {
  if (kind == ThingKind::kRoom) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector2d& corner : room->outline_map) {
      middle.head<2>() += corner / static_cast<double>(room->outline_map.size());
    }
    return middle;
  }
  const std::vector<Box> boxes = boxes_map();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double volume = 0.0;
  for (const Box& box : boxes) {
    sum += box.size_m.prod() * box.center.position_m;
    volume += box.size_m.prod();
  }
  return volume > 0.0 ? Eigen::Vector3d(sum / volume) : Eigen::Vector3d(T_map_thing().translation());
}

double distanceBetween(const Thing& a, const Thing& b) {
  const Eigen::Vector3d middle_map = a.middle_map();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Box& box : b.boxes_map()) {
    nearest_m = std::min(nearest_m, distanceTo(box, middle_map));
  }
  return std::isfinite(nearest_m) ? nearest_m : (middle_map - b.middle_map()).norm();
}

}  // namespace oikos::semantic
