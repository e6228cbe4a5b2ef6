// SPDX-License-Identifier: Apache-2.0
// From readings of a knob to the times in which it was set to one state.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "recognition/knobs/knob_reader.h"
#include "registration/scan.h"
#include "tracking/state/knob_track_config.h"

namespace oikos::tracking {

/// One picture of a knob.
struct KnobSighting {
  int frame = 0;  ///< of the recording
  std::int64_t stamp_ns = 0;
  recognition::KnobReading reading;
};

/// A time in which a knob was not turned.
struct KnobStay {
  std::size_t state = 0;        ///< index into the knob's states
  double probability = 0.0;     ///< of it against the others, from all pictures of the stay
  int images = 0;               ///< that show the knob,
  int found = 0;                ///< of these, those that have read the state by themselves
  std::int64_t first_ns = 0;    ///< of the first of those; if there is none: of the first image
  int first_frame = 0;          ///< that image
  int last_frame = 0;           ///< the last image of the stay
  int best_frame = 0;           ///< that shows it largest among those that have read it,
  registration::PixelBox crop;  ///< and where

  [[nodiscard]] bool isTold(const KnobTestConfig& config) const {
    return found >= config.min_images && probability >= config.min_probability;
  }
};

/// The likeliest course of a knob with `states` states: each picture speaks by the probabilities that it gives to them, turning costs its
/// prior (Viterbi 1967). `sightings`: in the order of time; pictures that do not show the knob say nothing. In the order of time.
[[nodiscard]] std::vector<KnobStay> fuseSightings(const std::vector<KnobSighting>& sightings, std::size_t states,
                                                  const KnobTestConfig& config);

}  // namespace oikos::tracking
