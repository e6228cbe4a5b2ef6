// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_state.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "semantic/history/event_json.h"
#include "semantic/xml/home_reader.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kBatch = 10000;
constexpr double kLimitSlack = 1e-6;  // of a joint's reading: a rounding
constexpr std::int64_t kAnyTime = std::numeric_limits<std::int64_t>::max();

template <class Items>
auto findById(Items& items, std::string_view id) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.id.value == id; });
  OIKOS_CHECK(found != items.end());
  return found;
}

[[noreturn]] void refuse(const Event& event, const std::string& what) {
  throw base::Error(base::ErrorCode::kInput, what, "event '" + std::string(base::toString(event.kind)) + "' of '" + event.subject + "'");
}

void checkJoint(const Event& event, const Joint& joint) {
  const auto& value = std::get<JointValue>(*event.after);
  if (value.type != joint.type) {
    refuse(event, joint.type == JointType::kRevolute ? "expected a value_deg: the joint is revolute"
                                                     : "expected a value_m: the joint is prismatic");
  }
  if (value.value < joint.lower - kLimitSlack || value.value > joint.upper + kLimitSlack) {
    refuse(event, "a value outside the joint's limits");
  }
}

/// What held before an event, as far as it still counts: what a taken back recording had said is none of it.
const std::optional<State>& stateUntil(const Event& event) {
  return event.kind == EventKind::kReverted ? event.after : event.before;
}

}  // namespace

HomeState::HomeState(Home home) : home_(std::move(home)) {
  for (std::size_t r = 0; r < home_.rooms.size(); ++r) {
    const Room& room = home_.rooms[r];
    locations_[room.id.value] = {Kind::kRoom, r, std::nullopt};
    for (std::size_t o = 0; o < room.objects.size(); ++o) {
      collect(r, o);
    }
    for (const SmallObject& small : room.small_objects) {
      locations_[small.id.value] = {Kind::kSmallObject, r, std::nullopt};
    }
  }
}

void HomeState::collect(std::size_t room, std::size_t object_number) {
  const LargeObject& object = home_.rooms[room].objects[object_number];
  locations_[object.id.value] = {Kind::kObject, room, object_number};
  for (const SmallObject& small : object.small_objects) {
    locations_[small.id.value] = {Kind::kSmallObject, room, object_number};
  }
  if (!object.articulation) {
    return;
  }
  for (const Part& part : object.articulation->parts) {
    locations_[part.id.value] = {Kind::kPart, room, object_number};
  }
  for (const Joint& joint : object.articulation->joints) {
    locations_[joint.id.value] = {Kind::kJoint, room, object_number};
  }
  for (const Knob& knob : object.articulation->knobs) {
    locations_[knob.id.value] = {Kind::kKnob, room, object_number};
  }
}

const LargeObject& HomeState::objectAt(const Location& location) const {
  return home_.rooms[location.room].objects[location.object.value()];
}

LargeObject& HomeState::editObjectAt(const Location& location) {
  return home_.rooms[location.room].objects[location.object.value()].edit();
}

std::vector<SmallObject>& HomeState::editCarriedAt(const Location& location) {
  return location.object ? editObjectAt(location).small_objects : home_.rooms[location.room].small_objects;
}

const std::vector<SmallObject>& HomeState::carriedAt(const Location& location) const {
  return location.object ? objectAt(location).small_objects : home_.rooms[location.room].small_objects;
}

std::optional<State> HomeState::findState(std::string_view subject) const {
  const auto found = locations_.find(std::string(subject));
  if (found == locations_.end()) {
    return std::nullopt;
  }
  const Location& location = found->second;
  switch (location.kind) {
    case Kind::kObject:
      return FurniturePose{objectAt(location).T_map_object};
    case Kind::kJoint: {
      const Joint& joint = *findById(objectAt(location).articulation->joints, subject);
      return JointValue{joint.type, joint.value};
    }
    case Kind::kKnob:
      return KnobSetting{findById(objectAt(location).articulation->knobs, subject)->current};
    case Kind::kSmallObject: {
      const SmallObject& small = *findById(carriedAt(location), subject);
      return Placement{small.parent, small.relation, small.T_parent_object};
    }
    case Kind::kPart:
    case Kind::kRoom:
      break;
  }
  return std::nullopt;
}

void HomeState::check(const Event& event) const {
  if (event.confidence < 0.0 || event.confidence > 1.0) {
    refuse(event, "a confidence outside 0 to 1");
  }
  const auto found = locations_.find(event.subject);
  if (found == locations_.end()) {
    refuse(event, "no such thing in the home");
  }
  const bool has_to_say = event.kind != EventKind::kReverted && event.kind != EventKind::kForgotten && event.kind != EventKind::kEdited &&
                          event.kind != EventKind::kAdded && event.kind != EventKind::kRemoved;
  if (has_to_say && !event.after) {
    refuse(event, "no 'after'");
  }
  if (event.after) {
    checkState(event, found->second);
  }
}

void HomeState::checkState(const Event& event, const Location& location) const {
  const State& after = *event.after;
  switch (location.kind) {
    case Kind::kObject:
      if (!std::holds_alternative<FurniturePose>(after)) {
        refuse(event, "expected a pose: it is a piece of furniture");
      }
      return;
    case Kind::kJoint:
      if (!std::holds_alternative<JointValue>(after)) {
        refuse(event, "expected a value_deg or value_m: it is a joint");
      }
      return checkJoint(event, *findById(objectAt(location).articulation->joints, event.subject));
    case Kind::kKnob: {
      const Knob& knob = *findById(objectAt(location).articulation->knobs, event.subject);
      const auto* const setting = std::get_if<KnobSetting>(&after);
      if (setting == nullptr ||
          std::none_of(knob.states.begin(), knob.states.end(), [&](const KnobState& state) { return state.name == setting->state; })) {
        refuse(event, "expected a setting that is one of the knob's states");
      }
      return;
    }
    case Kind::kSmallObject: {
      const auto* const placement = std::get_if<Placement>(&after);
      if (placement == nullptr) {
        refuse(event, "expected a placement: parent, relation, pose");
      }
      const auto parent = locations_.find(placement->parent);
      if (parent == locations_.end() ||
          (parent->second.kind != Kind::kObject && parent->second.kind != Kind::kPart && parent->second.kind != Kind::kRoom)) {
        refuse(event, "parent '" + placement->parent + "', which is no furniture, part or room of the home");
      }
      return;
    }
    case Kind::kPart:
    case Kind::kRoom:
      refuse(event, "it has no state of its own");
  }
}

void HomeState::setPlacement(const std::string& subject, const Placement& placement) {
  const auto parent = locations_.find(placement.parent);
  if (parent == locations_.end()) {
    return;  // what carried it has been taken out of home.xml: it stays where home.xml has it
  }
  Location& from = locations_.at(subject);
  const Location to{Kind::kSmallObject, parent->second.room, parent->second.object};
  std::vector<SmallObject>& there = editCarriedAt(from);
  const auto found = findById(there, subject);
  found->parent = placement.parent;
  found->relation = placement.relation;
  found->T_parent_object = placement.T_parent_object;
  if (from.room != to.room || from.object != to.object) {
    SmallObject moved = std::move(*found);
    there.erase(found);
    editCarriedAt(to).push_back(std::move(moved));
    from = to;
  }
}

void HomeState::set(const std::string& subject, const State& state) {
  const auto found = locations_.find(subject);
  if (found == locations_.end() || findState(subject) == state) {
    return;
  }
  const Location location = found->second;
  if (const auto* const placement = std::get_if<Placement>(&state); placement != nullptr && location.kind == Kind::kSmallObject) {
    setPlacement(subject, *placement);
  } else if (const auto* const pose = std::get_if<FurniturePose>(&state); pose != nullptr && location.kind == Kind::kObject) {
    editObjectAt(location).T_map_object = pose->T_map_object;
  } else if (const auto* const value = std::get_if<JointValue>(&state); value != nullptr && location.kind == Kind::kJoint) {
    const auto joint = findById(editObjectAt(location).articulation->joints, subject);
    joint->value = std::clamp(value->value, std::min(joint->lower, joint->upper), std::max(joint->lower, joint->upper));
  } else if (const auto* const setting = std::get_if<KnobSetting>(&state); setting != nullptr && location.kind == Kind::kKnob) {
    findById(editObjectAt(location).articulation->knobs, subject)->current = setting->state;
  }
}

void HomeState::setSeen(const std::string& subject, const std::optional<Event>& sighting) {
  const auto found = locations_.find(subject);
  if (found == locations_.end() || found->second.kind != Kind::kSmallObject) {
    return;
  }
  const std::optional<std::int64_t> last_seen_ns = sighting ? std::optional(sighting->time_ns) : std::nullopt;
  const std::optional<double> confidence = sighting ? std::optional(sighting->confidence) : std::nullopt;
  const SmallObject& small = *findById(carriedAt(found->second), subject);
  if (small.last_seen_ns != last_seen_ns || small.confidence != confidence) {
    SmallObject& edited = *findById(editCarriedAt(found->second), subject);
    edited.last_seen_ns = last_seen_ns;
    edited.confidence = confidence;
  }
}

void HomeState::takeFrom(const History& history, const std::string& subject) {
  const std::optional<Event> newest = history.findStateAt(subject, kAnyTime);
  if (!newest) {
    return;
  }
  newest_ns_[subject] = newest->time_ns;
  set(subject, *newest->after);
  if (!std::holds_alternative<Placement>(*newest->after)) {
    return;  // to look for a sighting among a joint's events would take all of them
  }
  const std::optional<Event> sighting = history.findSightingAt(subject, kAnyTime);
  if (sighting || newest->kind == EventKind::kReverted) {  // else what home.xml says of it stays
    setSeen(subject, sighting);
  }
}

void HomeState::apply(const Event& event, const History& history) {
  if (event.kind == EventKind::kMissed || event.kind == EventKind::kForgotten) {
    return;
  }
  const auto newest = newest_ns_.find(event.subject);
  if (newest == newest_ns_.end() || event.time_ns < newest->second || event.kind == EventKind::kReverted || !event.after) {
    takeFrom(history, event.subject);
    return;
  }
  newest->second = event.time_ns;
  set(event.subject, *event.after);
  if (event.kind == EventKind::kSighted) {
    setSeen(event.subject, event);
  }
}

void HomeState::takeNewFrom(const History& history, const std::function<void(const Event&)>& taken) {
  for (;;) {
    const std::vector<Event> events = history.eventsAfter(home_.as_of, kBatch);
    if (events.empty()) {
      return;
    }
    for (const Event& event : events) {
      apply(event, history);
      if (taken) {
        taken(event);
      }
    }
    home_.as_of = events.back().number;
  }
}

void prepareForCommit(std::vector<Event>& events, const HomeState& state, std::map<std::string, State>& changed) {
  std::map<std::string, State> mine = changed;
  for (Event& event : events) {
    state.check(event);
    const auto earlier = mine.find(event.subject);
    event.before = earlier != mine.end() ? std::optional(earlier->second) : state.findState(event.subject);
    if (event.after) {
      event.after = asStored(*event.after);
      if (event.kind != EventKind::kMissed && event.kind != EventKind::kForgotten) {
        mine.insert_or_assign(event.subject, *event.after);
      }
    }
  }
  changed = std::move(mine);
}

Home loadHome(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "home.xml";
  HomeState state(getHome(readHome(file), file));
  state.takeNewFrom(History(folder / "history.sqlite", HistoryAccess::kRead));
  return state.home();
}

Home homeAt(const Home& current, const History& history, std::int64_t time_ns) {
  HomeState state(current);
  for (const std::string& subject : history.subjects()) {
    if (const auto by_then = history.findStateAt(subject, time_ns)) {
      state.set(subject, *by_then->after);
    } else if (const auto later = history.findStateAfter(subject, time_ns); later && stateUntil(*later)) {
      state.set(subject, *stateUntil(*later));
    }
    const std::optional<State> shown = state.findState(subject);
    if (shown && std::holds_alternative<Placement>(*shown) && history.findSightingAt(subject, kAnyTime)) {
      state.setSeen(subject, history.findSightingAt(subject, time_ns));
    }
  }
  return state.home();
}

}  // namespace oikos::semantic
