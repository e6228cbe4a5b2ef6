// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/home_change.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "core/base/error.h"
#include "core/base/number_text.h"

namespace oikos::simulate {

namespace {

using namespace semantic;

using Words = std::vector<std::string>;

std::optional<double> findFinite(const std::string& word) {
  const std::optional<double> number = base::findNumber(word);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// From `X Y Z ROLL PITCH YAW`, the last six words.
std::optional<Pose> parsePose(const Words& words, std::size_t first) {
  if (words.size() != first + 6) {
    return std::nullopt;
  }
  Pose pose;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::optional<double> number = findFinite(words[first + i]);
    if (!number) {
      return std::nullopt;
    }
    const auto axis = static_cast<Eigen::Index>(i % 3);
    (i < 3 ? pose.position_m : pose.roll_pitch_yaw_rad)[axis] = i < 3 ? *number : *number * kRadPerDeg;
  }
  return pose;
}

std::optional<HomeChange> parseWords(const Words& words) {
  HomeChange change;
  if (words.size() < 2) {
    return std::nullopt;
  }
  change.id = words[0];
  if (words.size() == 2) {
    if (words[1] == "gone") {
      change.what = Gone{};
    } else {
      change.what = KnobChange{words[1]};
    }
    return change;
  }
  if (words.size() == 3 && findFinite(words[1]) && (words[2] == "deg" || words[2] == "m")) {
    const bool turns = words[2] == "deg";
    change.what = JointChange{*findFinite(words[1]) * (turns ? kRadPerDeg : 1.0), turns ? JointType::kRevolute : JointType::kPrismatic};
    return change;
  }
  if (words[1] == "at") {
    const auto pose = parsePose(words, 2);
    change.what = Moved{{}, Relation::kOn, pose.value_or(Pose{})};
    return pose ? std::optional(change) : std::nullopt;
  }
  const auto relation = base::findEnum<Relation>(words[1]);
  const auto pose = words.size() > 3 && words[3] == "at" ? parsePose(words, 4) : std::nullopt;
  if (!relation || !pose) {
    return std::nullopt;
  }
  change.what = Moved{words[2], *relation, *pose};
  return change;
}

[[noreturn]] void refuse(const HomeChange& change, const std::string& what, const std::string& where) {
  throw base::Error(base::ErrorCode::kInput, "changes: '" + change.id + "' " + what, where);
}

/// A copy of the piece of furniture that `is_wanted`, to be changed; null: none.
LargeObject* editWhere(Home& home, const std::function<bool(const LargeObject&)>& is_wanted) {
  for (Room& room : home.rooms) {
    for (CopyOnWrite<LargeObject>& object : room.objects) {
      if (is_wanted(*object)) {
        return &object.edit();
      }
    }
  }
  return nullptr;
}

template <class List>
auto* findById(List& list, const std::string& id) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.id.value == id; });
  return found == list.end() ? nullptr : &*found;
}

bool carries(const LargeObject& object, const std::string& id) {
  return object.id.value == id || (object.articulation && findById(object.articulation->parts, id) != nullptr);
}

/// Whether small objects can be put onto it: a room, a piece of furniture or one of its parts.
bool hasCarrier(const Home& home, const std::string& id) {
  return std::any_of(home.rooms.begin(), home.rooms.end(), [&](const Room& room) {
    return room.id.value == id ||
           std::any_of(room.objects.begin(), room.objects.end(), [&](const auto& object) { return carries(*object, id); });
  });
}

/// Takes a small object out of the home.
std::optional<SmallObject> takeSmall(Home& home, const std::string& id) {
  const auto takeFrom = [&](std::vector<SmallObject>& list) -> std::optional<SmallObject> {
    const auto found = std::find_if(list.begin(), list.end(), [&](const SmallObject& object) { return object.id.value == id; });
    if (found == list.end()) {
      return std::nullopt;
    }
    std::optional<SmallObject> taken = std::move(*found);
    list.erase(found);
    return taken;
  };
  for (Room& room : home.rooms) {
    if (auto taken = takeFrom(room.small_objects)) {
      return taken;
    }
  }
  LargeObject* const carrier = editWhere(home, [&](const LargeObject& o) { return findById(o.small_objects, id) != nullptr; });
  return carrier == nullptr ? std::nullopt : takeFrom(carrier->small_objects);
}

void takeAway(const HomeChange& change, Home& home, const std::string& where) {
  if (takeSmall(home, change.id)) {
    return;
  }
  for (Room& room : home.rooms) {
    const auto found =
        std::find_if(room.objects.begin(), room.objects.end(), [&](const auto& object) { return object->id.value == change.id; });
    if (found != room.objects.end()) {
      room.objects.erase(found);
      return;
    }
  }
  refuse(change, "is no object of this home", where);
}

void place(const HomeChange& change, const Moved& moved, Home& home, const std::string& where) {
  if (moved.parent.empty()) {
    LargeObject* const object = editWhere(home, [&](const LargeObject& o) { return o.id.value == change.id; });
    if (object == nullptr) {
      refuse(change, "is no piece of furniture of this home (a small object needs 'on PARENT at …')", where);
    }
    object->T_map_object = moved.pose;
    return;
  }
  if (!hasCarrier(home, moved.parent)) {
    refuse(change, "is put onto '" + moved.parent + "', which is no piece, part or room of this home", where);
  }
  std::optional<SmallObject> small = takeSmall(home, change.id);
  if (!small) {
    refuse(change, "is no small object of this home", where);
  }
  small->parent = moved.parent;
  small->relation = moved.relation;
  small->T_parent_object = moved.pose;
  Room* const room = findById(home.rooms, moved.parent);
  std::vector<SmallObject>& list = room != nullptr
                                       ? room->small_objects
                                       : editWhere(home, [&](const LargeObject& o) { return carries(o, moved.parent); })->small_objects;
  list.push_back(std::move(*small));
}

void setJoint(const HomeChange& change, const JointChange& value, Home& home, const std::string& where, BeyondLimits beyond) {
  LargeObject* const object =
      editWhere(home, [&](const LargeObject& o) { return o.articulation && findById(o.articulation->joints, change.id) != nullptr; });
  if (object == nullptr) {
    refuse(change, "is no joint of this home", where);
  }
  Joint& joint = *findById(object->articulation->joints, change.id);
  if (joint.type != value.type) {
    refuse(change, joint.type == JointType::kRevolute ? "turns: its value is in deg" : "slides: its value is in m", where);
  }
  constexpr double kRounding = 1e-6;
  const bool is_beyond = value.value < joint.lower - kRounding || value.value > joint.upper + kRounding;
  if (is_beyond && beyond == BeyondLimits::kRefuse) {
    const double unit = joint.type == JointType::kRevolute ? kRadPerDeg : 1.0;
    refuse(change,
           "= " + base::toText(value.value / unit) + ": its limits are " + base::toText(joint.lower / unit) + " and " +
               base::toText(joint.upper / unit),
           where);
  }
  joint.value = std::clamp(value.value, joint.lower, joint.upper);
}

void setKnob(const HomeChange& change, const KnobChange& value, Home& home, const std::string& where) {
  LargeObject* const object =
      editWhere(home, [&](const LargeObject& o) { return o.articulation && findById(o.articulation->knobs, change.id) != nullptr; });
  if (object == nullptr) {
    refuse(change, "is no knob of this home", where);
  }
  Knob& knob = *findById(object->articulation->knobs, change.id);
  const bool is_known = std::any_of(knob.states.begin(), knob.states.end(), [&](const KnobState& s) { return s.name == value.state; });
  if (!is_known) {
    refuse(change, "has no state '" + value.state + "'", where);
  }
  knob.current = value.state;
}

}  // namespace

std::optional<HomeChange> parseHomeChange(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  std::optional<double> at_s;
  if (!words.empty() && words.front().starts_with('@')) {
    at_s = findFinite(words.front().substr(1));
    if (!at_s || *at_s < 0.0) {
      return std::nullopt;
    }
    words.erase(words.begin());
  }
  std::optional<HomeChange> change = parseWords(words);
  if (change && at_s) {
    change->at_s = *at_s;
  }
  return change;
}

void apply(const HomeChange& change, Home& home, const std::string& where, BeyondLimits beyond) {
  if (const auto* const joint = std::get_if<JointChange>(&change.what)) {
    setJoint(change, *joint, home, where, beyond);
  } else if (const auto* const knob = std::get_if<KnobChange>(&change.what)) {
    setKnob(change, *knob, home, where);
  } else if (const auto* const moved = std::get_if<Moved>(&change.what)) {
    place(change, *moved, home, where);
  } else {
    takeAway(change, home, where);
  }
}

}  // namespace oikos::simulate
