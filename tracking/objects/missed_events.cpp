// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/missed_events.h"

#include <algorithm>

#include "semantic/history/event_json.h"

namespace oikos::tracking {

namespace {

constexpr std::size_t kNewest = 8;  // removed evidence is an event, too, and says nothing of places

const semantic::SmallObject* findIn(const std::vector<semantic::SmallObject>& objects, const semantic::ObjectId& id) {
  const auto found = std::find_if(objects.begin(), objects.end(), [&](const semantic::SmallObject& one) { return one.id == id; });
  return found == objects.end() ? nullptr : &*found;
}

const semantic::SmallObject* findSmall(const semantic::Home& home, const semantic::ObjectId& id) {
  for (const semantic::Room& room : home.rooms) {
    if (const auto* const on_floor = findIn(room.small_objects, id)) {
      return on_floor;
    }
    for (const semantic::LargeObject& object : room.objects) {
      if (const auto* const carried = findIn(object.small_objects, id)) {
        return carried;
      }
    }
  }
  return nullptr;
}

}  // namespace

std::optional<semantic::Event> missedEvent(const ObjectReading& reading, const semantic::Home& believed, std::int64_t start_ns) {
  const semantic::SmallObject* const object = findSmall(believed, reading.id);
  if (reading.status != WatchStatus::kMissed || object == nullptr) {
    return std::nullopt;
  }
  const semantic::Placement placement{object->parent, object->relation, object->T_parent_object};
  if (placement != reading.placement) {
    return std::nullopt;
  }
  semantic::Event event;
  event.time_ns = start_ns + reading.stamp_ns;
  event.frame = reading.frame;
  event.subject = reading.id.value;
  event.kind = semantic::EventKind::kMissed;
  event.before = placement;
  event.after = semantic::asStored(placement);
  event.confidence = std::clamp(reading.confidence, 0.0, 1.0);
  return event;
}

bool isKnown(const semantic::Event& missed, const semantic::History& history) {
  std::vector<semantic::Event> events = history.lastEventsOf(missed.subject, missed.time_ns, kNewest);
  std::erase_if(events, [](const semantic::Event& event) { return event.kind == semantic::EventKind::kForgotten; });
  return !events.empty() && events.back().kind == semantic::EventKind::kMissed && events.back().after == missed.after;
}

}  // namespace oikos::tracking
