// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/revert.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace oikos::semantic {

namespace {

constexpr std::int64_t kAnyTime = std::numeric_limits<std::int64_t>::max();

/// When each subject was last spoken of.
std::map<std::string, std::int64_t> lastTimes(const std::vector<Event>& events) {
  std::map<std::string, std::int64_t> last_ns;
  for (const Event& event : events) {
    const auto [time, is_new] = last_ns.try_emplace(event.subject, event.time_ns);
    time->second = std::max(time->second, event.time_ns);
  }
  return last_ns;
}

std::optional<State> stateWithout(const History& history, const std::string& subject, const std::string& recording) {
  const std::optional<Event> observed = history.findStateWithout(subject, recording);
  if (observed) {
    return observed->after;
  }
  const std::optional<Event> first = history.findFirstState(subject);
  return first ? first->before : std::nullopt;
}

Event revertedEvent(const History& history, const std::string& recording, const std::string& subject, std::int64_t last_ns) {
  Event event;
  event.time_ns = last_ns;
  event.recording = recording;
  event.subject = subject;
  event.kind = EventKind::kReverted;
  const std::optional<Event> newest = history.findStateAt(subject, kAnyTime);
  if (!newest) {
    return event;
  }
  event.before = newest->after;
  // An earlier taking back may have restored what this recording had said.
  if (newest->recording == recording || newest->kind == EventKind::kReverted) {
    event.after = stateWithout(history, subject, recording);
    event.time_ns = std::max(event.time_ns, newest->time_ns);
  }
  if (newest->kind == EventKind::kReverted && event.after == newest->after) {
    event.after.reset();
    event.time_ns = last_ns;
  }
  return event;
}

}  // namespace

Revert revertRecording(History& history, const std::string& recording) {
  const std::vector<Event> events = history.eventsOfRecording(recording);
  Revert revert;
  revert.events = static_cast<std::int64_t>(events.size());
  std::vector<Event> reverted;
  for (const auto& [subject, last_ns] : lastTimes(events)) {
    reverted.push_back(revertedEvent(history, recording, subject, last_ns));
    revert.subjects.push_back(subject);
    if (reverted.back().after) {
      revert.restored.push_back(subject);
    }
  }
  if (!reverted.empty()) {
    (void)history.append(reverted);
  }
  return revert;
}

}  // namespace oikos::semantic
