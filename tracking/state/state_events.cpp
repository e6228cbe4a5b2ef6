// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/state_events.h"

#include <algorithm>

namespace oikos::tracking {

namespace {

const semantic::Joint* findJoint(const semantic::Home& home, const semantic::ObjectId& object, const semantic::JointId& id) {
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& one : room.objects) {
      if (one.id != object || !one.articulation) {
        continue;
      }
      const auto& joints = one.articulation->joints;
      const auto found = std::find_if(joints.begin(), joints.end(), [&](const semantic::Joint& joint) { return joint.id == id; });
      return found == joints.end() ? nullptr : &*found;
    }
  }
  return nullptr;
}

StateEvent eventOf(const JointChange& change, const semantic::ObjectId& object, const semantic::Joint& joint, const EventSource& source) {
  semantic::Event event;
  event.time_ns = source.start_ns + change.stamp_ns;
  event.recording = source.recording;
  event.frame = change.frame;
  event.subject = joint.id.value;
  event.kind = semantic::EventKind::kJoint;
  event.before = semantic::JointValue{joint.type, change.before};
  event.after = semantic::JointValue{joint.type, change.after};
  event.confidence = std::clamp(change.confidence, 0.0, 1.0);
  return {event, object, change};
}

}  // namespace

std::vector<StateEvent> stateEvents(const std::vector<PieceReading>& readings, const semantic::Home& believed, const EventSource& source,
                                    const ChangeTestConfig& config) {
  std::vector<StateEvent> events;
  for (const PieceReading& piece : readings) {
    for (const JointReading& reading : piece.joints) {
      const semantic::Joint* const joint = findJoint(believed, piece.id, reading.id);
      if (joint == nullptr || joint->type != reading.type) {
        continue;
      }
      for (const JointChange& change : findChanges(reading.stays, *joint, config)) {
        events.push_back(eventOf(change, piece.id, *joint, source));
      }
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const StateEvent& a, const StateEvent& b) { return a.event.time_ns < b.event.time_ns; });
  return events;
}

}  // namespace oikos::tracking
