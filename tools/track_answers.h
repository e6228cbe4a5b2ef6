// SPDX-License-Identifier: Apache-2.0
// What `oikos track` says.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/track_batch.h"

namespace oikos::tools {

/// "fridge-door-joint opened 0.0 deg -> 70.2 deg".
[[nodiscard]] std::string eventText(const tracking::StateEvent& event);

/// Of the recording, while it was located and read.
[[nodiscard]] double framesPerSecond(const tracking::RecordingStates& states);

/// On stdout, for a person.
void printText(const TrackedRecording& recording, const TrackTask& task);

/// Metres and degrees, times RFC 3339.
[[nodiscard]] nlohmann::ordered_json toJson(const TrackOutcome& outcome, const TrackTask& task);

}  // namespace oikos::tools
