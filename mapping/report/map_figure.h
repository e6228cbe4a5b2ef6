// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mapping/report/report.h"

namespace oikos::mapping {

/// The path over the 2D grid from above, x to the right, y up: an inline SVG whose colours are the page's style classes. Before
/// loop closure in one colour, after it in another; loops as lines between the places that they tie together.
[[nodiscard]] std::string mapFigure(const MapReport& report);

}  // namespace oikos::mapping
