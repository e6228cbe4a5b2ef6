// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/knob_events.h"

namespace oikos::tracking {

std::vector<KnobTurn> findTurns(const TrackedKnob& knob, const std::string& believed, const KnobTestConfig& config) {
  std::vector<KnobTurn> turns;
  std::string known = believed;
  for (const KnobStay& stay : knob.stays) {
    const std::string& state = knob.states[stay.state];
    if (stay.isTold(config) && state != known) {
      turns.push_back({known, state, stay});
      known = state;
    }
  }
  return turns;
}

}  // namespace oikos::tracking
