// SPDX-License-Identifier: Apache-2.0
// What `oikos track` says.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/track_batch.h"

namespace oikos::tools {

/// On stdout, for a person.
void printText(const TrackedRecording& recording, bool is_dry);

/// Metres and degrees, times RFC 3339.
[[nodiscard]] nlohmann::ordered_json toJson(const TrackOutcome& outcome, bool is_dry);

}  // namespace oikos::tools
