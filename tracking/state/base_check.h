// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "semantic/model/home.h"
#include "tracking/furniture/furniture_places.h"
#include "tracking/state/state_reader.h"

namespace oikos::tracking {

/// Whether the images that doors and drawers were read from have the piece where it is believed to be, and `place` has it elsewhere,
/// farther than a registration follows it. A leaf that stands open before a cupboard looks like its front; the images that explain leaf and
/// body are right.
[[nodiscard]] bool isRefuted(const FurniturePlace& place, const semantic::LargeObject& believed, const std::vector<PieceReading>& pieces);

}  // namespace oikos::tracking
