// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/report/report.h"

namespace oikos::mapping {

/// One value a frame over the drive's time; NaN leaves a gap.
struct FramePlot {
  std::string label;  ///< for readers that see no picture; plain text
  std::string unit;   ///< at the axis; plain text
  std::string style_class;
  std::vector<double> values;
};

/// Inline SVG: the middle value of each stretch of the drive as a line, least to greatest as a band behind it; below it a strip
/// that shows where tracking was lost, carried or found again. `report` gives times and states.
[[nodiscard]] std::string framePlot(const MapReport& report, const FramePlot& plot);

}  // namespace oikos::mapping
