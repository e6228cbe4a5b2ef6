// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_edits.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace oikos::semantic {

namespace {

/// Everything in a home that an event can have as its subject, by id: its state, and the rest of it to be compared.
struct Subject {
  std::optional<State> state;
  std::variant<Home, Room, LargeObject, Joint, Knob, SmallObject> rest;
};
using Subjects = std::map<std::string, Subject>;

LargeObject withoutStates(LargeObject object) {
  object.small_objects.clear();
  object.T_map_object = {};
  if (object.articulation) {
    object.articulation->joints.clear();
    object.articulation->knobs.clear();
  }
  return object;
}

SmallObject withoutStates(SmallObject object) {
  object.parent.clear();
  object.relation = {};
  object.T_parent_object = {};
  object.last_seen_ns.reset();
  object.confidence.reset();
  return object;
}

void collect(const SmallObject& small, Subjects& subjects) {
  subjects[small.id.value] = {Placement{small.parent, small.relation, small.T_parent_object}, withoutStates(small)};
}

void collect(const LargeObject& object, Subjects& subjects) {
  subjects[object.id.value] = {FurniturePose{object.T_map_object}, withoutStates(object)};
  for (const SmallObject& small : object.small_objects) {
    collect(small, subjects);
  }
  if (!object.articulation) {
    return;
  }
  for (Joint joint : object.articulation->joints) {
    const State state = JointValue{joint.type, joint.value};
    joint.value = 0.0;
    subjects[joint.id.value] = {state, joint};
  }
  for (Knob knob : object.articulation->knobs) {
    const State state = KnobSetting{knob.current};
    knob.current.clear();
    subjects[knob.id.value] = {state, knob};
  }
}

void collectOutside(const Home& home, Subjects& subjects) {
  for (const Room& room : home.rooms) {
    Room bare = room;
    bare.objects.clear();
    bare.small_objects.clear();
    subjects[room.id.value] = {std::nullopt, bare};
    for (const SmallObject& small : room.small_objects) {
      collect(small, subjects);
    }
  }
  Home bare = home;
  bare.rooms.clear();
  bare.as_of = 0;
  subjects[home.id] = {std::nullopt, bare};
}

/// The furniture that the other home does not have just so.
void collectDifferent(const Home& home, const Home& other, Subjects& subjects) {
  std::map<std::string, const CopyOnWrite<LargeObject>*> others;
  for (const Room& room : other.rooms) {
    for (const auto& object : room.objects) {
      others[object->id.value] = &object;
    }
  }
  for (const Room& room : home.rooms) {
    for (const auto& object : room.objects) {
      const auto same = others.find(object->id.value);
      if (same == others.end() || !(*same->second == object)) {
        collect(*object, subjects);
      }
    }
  }
}

Event eventOf(EventKind kind, const std::string& subject, std::int64_t time_ns) {
  Event event;
  event.kind = kind;
  event.subject = subject;
  event.time_ns = time_ns;
  return event;
}

}  // namespace

std::vector<Event> editsBetween(const Home& before, const Home& after, std::int64_t time_ns) {
  Subjects old_ones;
  Subjects new_ones;
  collectOutside(before, old_ones);
  collectOutside(after, new_ones);
  collectDifferent(before, after, old_ones);
  collectDifferent(after, before, new_ones);
  std::vector<Event> events;
  for (const auto& [id, now] : new_ones) {
    const auto old = old_ones.find(id);
    if (old == old_ones.end()) {
      events.push_back(eventOf(EventKind::kAdded, id, time_ns));
      events.back().after = now.state;
    } else if (old->second.state != now.state) {
      events.push_back(eventOf(EventKind::kEdited, id, time_ns));
      events.back().before = old->second.state;
      events.back().after = now.state;
    } else if (old->second.rest != now.rest) {
      events.push_back(eventOf(EventKind::kEdited, id, time_ns));
    }
  }
  for (const auto& [id, old] : old_ones) {
    if (!new_ones.contains(id)) {
      events.push_back(eventOf(EventKind::kRemoved, id, time_ns));
      events.back().before = old.state;
    }
  }
  return events;
}

}  // namespace oikos::semantic
