// SPDX-License-Identifier: Apache-2.0
// From a knob's stays to what happened to it.
#pragma once

#include <string>
#include <vector>

#include "tracking/state/knob_watch.h"

namespace oikos::tracking {

/// A knob that is set to another state than was known.
struct KnobTurn {
  std::string before;
  std::string after;
  KnobStay stay;  ///< in the new state
};

/// Each stay that can be told is held against the one before it, the first against `believed`. In the order of time.
[[nodiscard]] std::vector<KnobTurn> findTurns(const TrackedKnob& knob, const std::string& believed, const KnobTestConfig& config);

}  // namespace oikos::tracking
