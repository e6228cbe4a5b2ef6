// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::semantic {

enum class ThingKind { kRoom, kLargeObject, kPart, kKnob, kSmallObject };

/// Anything in a home that has a name, with the way down to it. Points into the home.
struct Thing {
  ThingKind kind = ThingKind::kRoom;
  const Room* room = nullptr;
  const LargeObject* object = nullptr;  ///< null: a room, or a small object on its floor
  const Part* part = nullptr;           ///< of a part; of a small object: that carries it
  const Knob* knob = nullptr;
  const SmallObject* small_object = nullptr;

  [[nodiscard]] const std::string& id() const;
  /// As a person would say it: the label, else colour and type.
  [[nodiscard]] std::string name() const;
  /// Of a room: the identity.
  [[nodiscard]] Eigen::Isometry3d T_map_thing() const;
  /// Its middle, by its boxes where it has any; of a room: of its outline, on the floor.
  [[nodiscard]] Eigen::Vector3d middle_map() const;
  /// Its boxes in map; none: not known.
  [[nodiscard]] std::vector<Box> boxes_map() const;
  bool operator==(const Thing&) const = default;
};

/// As a person would say it: the label, else what the id says beyond that of its furniture, with the number as an ordinal among its like:
/// "wardrobe-left_door" is "left door", "oven-knob_0" "first knob".
[[nodiscard]] std::string partName(const LargeObject& object, const Part& part);
[[nodiscard]] std::string knobName(const LargeObject& object, const Knob& knob);

/// '_' as a space.
[[nodiscard]] std::string spaced(std::string name);

/// From `a`'s middle to the nearest of `b`'s boxes, or to its middle.
[[nodiscard]] double distanceBetween(const Thing& a, const Thing& b);

}  // namespace oikos::semantic
