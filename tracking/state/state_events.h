// SPDX-License-Identifier: Apache-2.0
// What a recording's readings change of a home, as events of its history.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "registration/scan.h"
#include "semantic/history/event.h"
#include "semantic/model/home.h"
#include "tracking/state/change_moment.h"
#include "tracking/state/recording_states.h"

namespace oikos::tracking {

/// An event, and what it is to be shown by.
struct StateEvent {
  semantic::Event event;  ///< without `evidence`
  semantic::ObjectId object;
  std::string word;                           ///< opened, closed, moved, turned, missed
  double sigma = 0.0;                         ///< of what stands in `after`: rad of a hinge, else m; 0 of a knob and of what is missed
  int evidence_frame = 0;                     ///< the picture that shows it best,
  registration::PixelBox crop;                ///< and where; empty: all of it
  std::optional<ImageTime> last_before = {};  ///< of a door or drawer: as ChangeMoment has it; the event's time is its `first_after`
};

struct EventSource {
  std::string recording;      ///< its name in the history
  std::int64_t start_ns = 0;  ///< UTC of stamp 0
};

/// `believed`: the home as it was known to be when the recording was made. What it no longer has is passed over. In the order of time, then
/// doors and drawers before furniture before small objects, each in the home's order. A miss is an event whatever the history has said
/// before: see isKnown().
[[nodiscard]] std::vector<StateEvent> stateEvents(const RecordingStates& states, const semantic::Home& believed, const EventSource& source,
                                                  const StateConfig& config);

}  // namespace oikos::tracking
