// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/thing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "semantic/model/placement.h"
#include "semantic/model/relations.h"
#include "semantic/query/time_words.h"

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

/// An id without its furniture's, and without its number.
struct IdWords {
  std::string noun;
  std::optional<int> number;
};

IdWords wordsOfId(const LargeObject& object, std::string_view id) {
  const std::string& whole = object.id.value;
  if (id.size() > whole.size() + 1 && id.starts_with(whole) && (id[whole.size()] == '-' || id[whole.size()] == '_')) {
    id.remove_prefix(whole.size() + 1);
  }
  IdWords words{std::string(id), std::nullopt};
  std::replace(words.noun.begin(), words.noun.end(), '-', ' ');
  words.noun = spaced(words.noun);
  const std::size_t space = words.noun.rfind(' ');
  if (space != std::string::npos && space > 0) {
    words.number = wholeNumber(std::string_view(words.noun).substr(space + 1));
    words.noun = words.number ? words.noun.substr(0, space) : words.noun;
  }
  return words;
}

/// `like`: all parts or knobs of the furniture.
template <class Like>
std::string spokenId(const LargeObject& object, const std::string& id, const std::vector<Like>& like) {
  constexpr std::array<std::string_view, 10> ordinals{"first", "second",  "third",  "fourth", "fifth",
                                                      "sixth", "seventh", "eighth", "ninth",  "tenth"};
  const IdWords words = wordsOfId(object, id);
  if (!words.number) {
    return words.noun;
  }
  std::size_t before = 0;
  std::size_t same = 0;
  for (const Like& other : like) {
    const IdWords theirs = wordsOfId(object, other.id.value);
    const bool alike = theirs.number && theirs.noun == words.noun;
    same += alike ? 1 : 0;
    before += alike && *theirs.number < *words.number ? 1 : 0;
  }
  if (same == 1) {
    return words.noun;
  }
  return before < ordinals.size() ? std::string(ordinals[before]) + " " + words.noun : words.noun + " " + std::to_string(before + 1);
}

Eigen::Isometry3d carrierInMap(const Thing& thing, const std::string& carrier) {
  return findCarrierInMap(*thing.object, carrier).value_or(thing.object->T_map_object.toIsometry());
}

}  // namespace

std::string partName(const LargeObject& object, const Part& part) {
  return !part.label.empty() || !object.articulation ? labelled(part.label, part.id.value)
                                                     : spokenId(object, part.id.value, object.articulation->parts);
}

std::string knobName(const LargeObject& object, const Knob& knob) {
  return !knob.label.empty() || !object.articulation ? labelled(knob.label, knob.id.value)
                                                     : spokenId(object, knob.id.value, object.articulation->knobs);
}

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
      return partName(*object, *part) + " of the " + labelled(object->label, object->type);
    case ThingKind::kKnob:
      return knobName(*object, *knob) + " of the " + labelled(object->label, object->type);
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
