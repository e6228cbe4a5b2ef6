// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/state_events.h"

#include <algorithm>
#include <optional>

#include "core/base/degrees.h"
#include "tracking/objects/missed_events.h"
#include "tracking/state/joint_changes.h"
#include "tracking/state/knob_events.h"

namespace oikos::tracking {

namespace {

const semantic::LargeObject* findObject(const semantic::Home& home, const semantic::ObjectId& id) {
  for (const semantic::Room& room : home.rooms) {
    const auto found =
        std::find_if(room.objects.begin(), room.objects.end(), [&](const semantic::LargeObject& object) { return object.id == id; });
    if (found != room.objects.end()) {
      return &static_cast<const semantic::LargeObject&>(*found);
    }
  }
  return nullptr;
}

template <class Item, class ItemId>
const Item* findById(const std::vector<Item>& items, const ItemId& id) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.id == id; });
  return found == items.end() ? nullptr : &*found;
}

const semantic::Articulation* findArticulation(const semantic::Home& home, const semantic::ObjectId& id) {
  const semantic::LargeObject* const object = findObject(home, id);
  return object != nullptr && object->articulation ? &*object->articulation : nullptr;
}

StateEvent eventOf(const JointChange& change, const JointReading& reading, const semantic::ObjectId& object, const EventSource& source,
                   const registration::JointFusionConfig& config) {
  const ChangeMoment moment = momentOf(change, reading, config);
  const JointStay& stay = reading.stays[change.stay];
  semantic::Event event;
  event.time_ns = source.start_ns + moment.first_after.stamp_ns;
  event.recording = source.recording;
  event.frame = moment.first_after.frame;
  event.subject = reading.id.value;
  event.kind = semantic::EventKind::kJoint;
  event.before = semantic::JointValue{reading.type, change.before};
  event.after = semantic::JointValue{reading.type, change.after};
  event.confidence = std::clamp(change.confidence, 0.0, 1.0);
  return {event, object, std::string(base::toString(change.kind)), change.sigma, stay.best_frame, stay.crop, moment.last_before};
}

StateEvent eventOf(const KnobTurn& turn, const TrackedKnob& knob, const EventSource& source) {
  semantic::Event event;
  event.time_ns = source.start_ns + turn.stay.first_ns;
  event.recording = source.recording;
  event.frame = turn.stay.first_frame;
  event.subject = knob.id.value;
  event.kind = semantic::EventKind::kKnob;
  event.before = semantic::KnobSetting{turn.before};
  event.after = semantic::KnobSetting{turn.after};
  event.confidence = std::clamp(turn.stay.probability, 0.0, 1.0);
  return {event, knob.piece, "turned", 0.0, turn.stay.best_frame, turn.stay.crop};
}

/// Nothing: it stands where it is believed to.
std::optional<StateEvent> moveOf(const FurniturePlace& place, const semantic::LargeObject& object, const EventSource& source,
                                 const MovedFurnitureConfig& config) {
  const Eigen::Isometry3d T_believed_found = object.T_map_object.toIsometry().inverse() * place.T_map_object;
  if (T_believed_found.translation().norm() < config.min_moved_m &&
      Eigen::AngleAxisd(T_believed_found.linear()).angle() < config.min_moved_deg * base::kRadPerDeg) {
    return std::nullopt;
  }
  semantic::Event event;
  event.time_ns = source.start_ns + place.stamp_ns;
  event.recording = source.recording;
  event.frame = place.frame;
  event.subject = object.id.value;
  event.kind = semantic::EventKind::kMoved;
  event.before = semantic::FurniturePose{object.T_map_object};
  event.after = semantic::FurniturePose{semantic::Pose::fromIsometry(place.T_map_object)};
  event.confidence = std::clamp(place.fit, 0.0, 1.0);
  return StateEvent{event, object.id, "moved", place.spread_m, place.frame, {}};
}

}  // namespace

std::vector<StateEvent> stateEvents(const RecordingStates& states, const semantic::Home& believed, const EventSource& source,
                                    const StateConfig& config) {
  std::vector<StateEvent> events;
  for (const PieceReading& piece : states.pieces) {
    const semantic::Articulation* const articulation = findArticulation(believed, piece.id);
    for (const JointReading& reading : piece.joints) {
      const semantic::Joint* const joint = articulation != nullptr ? findById(articulation->joints, reading.id) : nullptr;
      if (joint == nullptr || joint->type != reading.type) {
        continue;
      }
      for (const JointChange& change : findChanges(reading.stays, *joint, config.change)) {
        events.push_back(eventOf(change, reading, piece.id, source, config.fusion));
      }
    }
  }
  for (const TrackedKnob& tracked : states.knobs) {
    const semantic::Articulation* const articulation = findArticulation(believed, tracked.piece);
    const semantic::Knob* const knob = articulation != nullptr ? findById(articulation->knobs, tracked.id) : nullptr;
    if (knob != nullptr) {
      for (const KnobTurn& turn : findTurns(tracked, knob->current, config.knobs.test)) {
        events.push_back(eventOf(turn, tracked, source));
      }
    }
  }
  for (const FurniturePlace& place : states.furniture) {
    const semantic::LargeObject* const object = findObject(believed, place.id);
    if (object != nullptr) {
      if (auto event = moveOf(place, *object, source, config.furniture)) {
        events.push_back(*std::move(event));
      }
    }
  }
  for (const ObjectReading& reading : states.objects) {
    if (auto event = missedEvent(reading, believed, source.start_ns)) {
      event->recording = source.recording;
      events.push_back({*std::move(event), reading.id, "missed", 0.0, reading.evidence_frame, reading.crop});
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const StateEvent& a, const StateEvent& b) { return a.event.time_ns < b.event.time_ns; });
  return events;
}

}  // namespace oikos::tracking
