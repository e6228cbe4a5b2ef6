// SPDX-License-Identifier: Apache-2.0
// Where about its believed place a grip may be: all places of a grid, each held against the readings. Included by this folder's sources
// only.
#pragma once

#include <vector>

#include "registration/handles/blurred_bar.h"
#include "registration/handles/grip_config.h"
#include "registration/handles/grip_evidence.h"
#include "registration/handles/grip_readings.h"

namespace oikos::registration {

/// A place of the grid, with the blur that it was compared under.
struct GridPlace {
  double along_m = 0.0;   ///< z of the believed grip
  double across_m = 0.0;  ///< and y
  double blur_m = 0.0;
  double gain = 0.0;   ///< log likelihood over that of a bare front, at the height that fits best
  double score = 0.0;  ///< the same, with what was believed of the place
};

/// Places at which something of the believed grip's shape stands out, under the sharp blur or the wide one, with half of the gain that a
/// grip must have: the best first, `apart_m` from each other, `most_places` at most. `believed`: as believedBar().
[[nodiscard]] std::vector<GridPlace> bestOfGrid(const GripReadings& grip, const Bar& believed, const GripConfig& config);

/// What the readings say of each place of the grid, row by row (along, then across), under the wide blur.
[[nodiscard]] std::vector<PlaceEvidence> evidenceOverGrid(const GripReadings& grip, const Bar& believed, const GripConfig& config);

}  // namespace oikos::registration
