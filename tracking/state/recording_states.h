// SPDX-License-Identifier: Apache-2.0
// A whole recording: where it was, and what it says of doors, drawers, knobs, shiftable furniture and small objects.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/recording.h"
#include "semantic/model/home.h"
#include "tracking/furniture/furniture_places.h"
#include "tracking/localisation/localiser.h"
#include "tracking/objects/missed_test.h"
#include "tracking/state/knob_watch.h"
#include "tracking/state/state_config.h"
#include "tracking/state/state_reader.h"

namespace oikos::tracking {

struct RecordingStates {
  int frames = 0;         ///< of the recording
  int located = 0;        ///< frames that were looked for
  int found = 0;          ///< and found
  int unreadable = 0;     ///< frames that could not be decoded
  int registrations = 0;  ///< of a piece in a frame
  double locating_s = 0.0;
  double reading_s = 0.0;
  std::vector<PieceReading> pieces;
  std::vector<FurniturePlace> furniture;  ///< of shiftable pieces, those whose views agree
  std::vector<TrackedKnob> knobs;
  std::vector<ObjectReading> objects;  ///< small ones that were looked for
};

/// Every how many frames one is looked at, so that there are no more than `most_hz` in a second.
[[nodiscard]] int strideOf(const recording::Recording& recording, double most_hz);

/// What a recording is read with.
struct StateTools {
  const semantic::Home& home;  ///< as it is believed
  std::filesystem::path home_folder;
  Localiser& localiser;
  StateReader& reader;
  const StateConfig& config;
  int threads = 1;
  std::string only = {};  ///< one piece; empty: all
  base::ProgressSink progress = {};
};

/// Reads the recording to its end, then once more the frames that tell most; only a few frames are in memory at a time. The same result for
/// any number of threads. Throws Error{kInput} if too many frames cannot be read.
[[nodiscard]] RecordingStates readStates(const recording::Recording& recording, const StateTools& tools);

}  // namespace oikos::tracking
