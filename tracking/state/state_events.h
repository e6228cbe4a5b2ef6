// SPDX-License-Identifier: Apache-2.0
// What a recording's readings change of a home, as events of its history.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "semantic/history/event.h"
#include "semantic/model/home.h"
#include "tracking/state/joint_changes.h"
#include "tracking/state/state_reader.h"

namespace oikos::tracking {

/// An event, and what it is to be shown by.
struct StateEvent {
  semantic::Event event;  ///< without `evidence`
  semantic::ObjectId object;
  JointChange change;
};

struct EventSource {
  std::string recording;      ///< its name in the history
  std::int64_t start_ns = 0;  ///< UTC of stamp 0
};

/// `believed`: the home as it was known to be when the recording was made. What it no longer has is passed over. In the order of time, then
/// of the home.
[[nodiscard]] std::vector<StateEvent> stateEvents(const std::vector<PieceReading>& readings, const semantic::Home& believed,
                                                  const EventSource& source, const ChangeTestConfig& config);

}  // namespace oikos::tracking
