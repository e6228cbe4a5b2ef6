// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/sentence.h"

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "semantic/model/pose.h"
#include "semantic/query/found_thing.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text;
}

std::string enumerated(const std::vector<std::string>& texts) {
  std::string text;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    text += i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ";
    text += texts[i];
  }
  return text;
}

std::string theName(const Thing& thing) {
  return "the " + thing.name();
}

bool isPlural(const Thing& thing) {
  constexpr auto singulars = std::to_array<std::string_view>({"atlas", "canvas", "iris", "lens", "news", "series", "thermos"});
  const std::string name = thing.name();
  const std::string head = name.substr(0, name.find(" of "));
  const std::string last = head.substr(head.rfind(' ') + 1);  // npos + 1 is 0
  return singularOf(last) != last && std::find(singulars.begin(), singulars.end(), last) == singulars.end();
}

std::vector<std::string> countedOnce(const std::vector<std::string>& texts) {
  std::vector<std::string> counted;
  for (auto text = texts.begin(); text != texts.end(); ++text) {
    if (std::find(texts.begin(), text, *text) == text) {
      const auto count = std::count(text, texts.end(), *text);
      counted.push_back(*text + (count > 1 ? " (" + std::to_string(count) + " of them)" : ""));
    }
  }
  return counted;
}

namespace {

/// Where another piece of the room is called the same: what stands nearest of those with another name. Empty: no other is called so.
std::string neighbourText(const Thing& thing) {
  const std::string name = thing.name();
  bool is_unique = true;
  std::string nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const LargeObject& other : thing.room->objects) {
    if (&other == thing.object) {
      continue;
    }
    const Thing candidate{ThingKind::kLargeObject, thing.room, &other, nullptr, nullptr, nullptr};
    if (candidate.name() == name) {
      is_unique = false;
    } else if (const double distance_m = distanceBetween(thing, candidate); distance_m < nearest_m) {
      nearest_m = distance_m;
      nearest = theName(candidate);
    }
  }
  return is_unique || nearest.empty() ? "" : ", by " + nearest;
}

}  // namespace

std::string placeText(const Thing& thing) {
  if (thing.kind == ThingKind::kRoom) {
    return "a room of the home";
  }
  if (thing.kind != ThingKind::kSmallObject) {
    return "in the " + thing.room->name + (thing.kind == ThingKind::kLargeObject ? neighbourText(thing) : "");
  }
  const std::string in_room = "in the " + thing.room->name;
  if (thing.object == nullptr) {
    return (thing.small_object->relation == Relation::kOn ? "on the floor " : "") + in_room;
  }
  const bool in_moving_part = thing.part != nullptr && !thing.part->parent.value.empty();
  Thing carrier = thing;
  carrier.kind = in_moving_part ? ThingKind::kPart : ThingKind::kLargeObject;
  return std::string(base::toString(thing.small_object->relation)) + " the " + carrier.name() + " " + in_room;
}

std::string openingText(const Joint& joint) {
  return joint.type == JointType::kRevolute ? base::toFixedText(openingOf(joint) / kRadPerDeg, 0) + " degrees"
                                            : base::toFixedText(openingOf(joint) * 100.0, 0) + " cm";
}

std::string stateText(const Thing& thing) {
  const std::vector<const Joint*> joints = jointsOf(thing);
  std::vector<std::string> states;
  for (const Joint* joint : joints) {
    OIKOS_CHECK(thing.object->articulation.has_value());
    const auto& parts = thing.object->articulation->parts;
    const auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.id == joint->child; });
    const bool named = joints.size() > 1 && part != parts.end();
    const std::string name = named ? "its " + partName(*thing.object, *part) + " is " : "";
    states.push_back(name + (isOpen(*joint) ? "open by " + openingText(*joint) : "closed"));
  }
  return enumerated(states);
}

std::string positionText(const Eigen::Vector3d& position_map) {
  return "(" + base::toFixedText(position_map.x(), 2) + ", " + base::toFixedText(position_map.y(), 2) + ")";
}

std::string standText(const Eigen::Isometry3d& T_map_base) {
  const double yaw_deg = Pose::fromIsometry(T_map_base).roll_pitch_yaw_rad.z() / kRadPerDeg;
  return positionText(T_map_base.translation()) + ", facing " + base::toFixedText(std::round(yaw_deg) + 0.0, 0) +
         " degrees";  // + 0.0: no "-0"
}

}  // namespace oikos::semantic
