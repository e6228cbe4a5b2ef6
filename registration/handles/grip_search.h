// SPDX-License-Identifier: Apache-2.0
// Where a grip stands out of its front. Included by this folder's sources and tests only.
#pragma once

#include <vector>

#include "registration/handles/bar_fit.h"
#include "registration/handles/grip_config.h"
#include "registration/handles/grip_evidence.h"
#include "registration/handles/grip_readings.h"

namespace oikos::registration {

/// Places at which a grip explains the readings better than a bare front does by `min_gain`, the best first, `apart_m` from each other: a
/// search over a grid (the believed grip's blurred shape against the heights), then Gauss-Newton from each with the belief as prior.
[[nodiscard]] std::vector<GripPlace> searchGrip(const GripBelief& belief, const GripReadings& readings, const GripConfig& config);

/// What the readings say of each place that is searched, as a sensor shows it that takes handle and front for one surface.
[[nodiscard]] std::vector<PlaceEvidence> evidenceOf(const GripBelief& belief, const GripReadings& readings, const GripConfig& config);

}  // namespace oikos::registration
