// SPDX-License-Identifier: Apache-2.0
// A bar brought onto the readings around it. Included by this folder's sources only.
#pragma once

#include "registration/handles/blurred_bar.h"
#include "registration/handles/grip_config.h"
#include "registration/handles/grip_readings.h"

namespace oikos::registration {

constexpr double kSeenOfBar = 0.785;  ///< of a round bar's radius, what its visible side stands out in the mean

/// One place where something stands out as a handle does.
struct GripPlace {
  Bar bar;
  BarMatrix covariance = BarMatrix::Zero();  ///< in the order of Bar
  double gain = 0.0;                         ///< log likelihood over that of a bare front
  double score = 0.0;                        ///< the same, with what was believed of the place
  int readings = 0;                          ///< that show it, at least half
};

/// The bar that is believed, without its height being known.
[[nodiscard]] Bar believedBar(const GripBelief& belief);

/// Gauss-Newton from `start`, with what is believed of the grip as prior and Huber's loss. Readings farther from the start than the bar,
/// its blur and a rim do not count; a step is damped until it helps. A knob stays square.
[[nodiscard]] GripPlace fitBar(const GripBelief& belief, const Bar& start, const GripReadings& readings, const GripConfig& config);

}  // namespace oikos::registration
