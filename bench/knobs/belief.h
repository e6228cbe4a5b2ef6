// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recognition/knobs/knob.h"
#include "recognition/knobs/training/panel.h"

namespace oikos::bench {

/// A knob as it is believed: its dimensions off as those of a tape measure are (2 % of the radius, 4 % of the height, 10 % of the mark's
/// breadth), turned clockwise from `zero_rad` on, with evenly spread states.
[[nodiscard]] recognition::KnobDescription believe(const recognition::DrawnKnob& drawn, double zero_rad, recognition::Random& random);

/// How far its part is believed from where it is: 3 mm and 1 degree each way.
[[nodiscard]] Eigen::Isometry3d drawMisplacement(recognition::Random& random);

}  // namespace oikos::bench
