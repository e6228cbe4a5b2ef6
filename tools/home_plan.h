// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mapping/floorplan/floor_plan.h"
#include "semantic/model/home.h"

namespace oikos::tools {

/// The outlines of the home's rooms as a plan, frame map; without lines if no room has one.
[[nodiscard]] mapping::FloorPlan planOf(const semantic::Home& home);

}  // namespace oikos::tools
