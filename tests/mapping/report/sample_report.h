// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mapping/report/report.h"

namespace oikos::mapping::test {

/// A good drive: 40 frames at 10 Hz, 10 cm apart around a square with sides of one metre, every fourth a keyframe; odometry
/// alone ends 8 cm off; one loop accepted, one refused; a grid of 30 × 20 cells of 10 cm, all free but for one wall.
[[nodiscard]] MapReport sampleReport();

/// The same, laid onto a floor plan of one wall.
[[nodiscard]] MapReport reportOnPlan();

/// The same, of a drive that extended a map of three frames; one thing has gone, and a loop leads to the last of them.
[[nodiscard]] MapReport extendedReport();

}  // namespace oikos::mapping::test
