// SPDX-License-Identifier: Apache-2.0
// What a recording says of small objects, once its doors, drawers and furniture have been read.
#pragma once

#include <functional>
#include <vector>

#include "tracking/objects/object_watch.h"
#include "tracking/state/recording_states.h"

namespace oikos::tracking {

/// What the recording says of all that carries small objects.
[[nodiscard]] CarrierReadings carriersOf(const RecordingStates& states, const MovedFurnitureConfig& config);

/// A frame of the recording, and where it was, as well as that can be told.
using ReadFrame = std::function<camera::RgbdFrame(int frame)>;

/// `states`: with pieces and furniture. `read`: gives a frame and places it in `tools.reader`. With one piece on demand nothing is looked
/// for. Throws what `read` throws, and as ObjectWatch.
[[nodiscard]] std::vector<ObjectReading> readObjects(const RecordingStates& states, const camera::PinholeCamera& camera,
                                                     const StateTools& tools, const ReadFrame& read);

}  // namespace oikos::tracking
