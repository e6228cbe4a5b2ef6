// SPDX-License-Identifier: Apache-2.0
// Angles are radians inside and degrees in files.
#pragma once

#include <numbers>

namespace oikos::base {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// The angle in degrees, as the number with the fewest digits that comes back as the same radians; where none does, the nearest.
[[nodiscard]] double toDegrees(double rad);

}  // namespace oikos::base
