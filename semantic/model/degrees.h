// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace oikos::semantic {

/// The angle in degrees, as the number with the fewest digits that comes back as the same radians; where none does, the nearest.
[[nodiscard]] double toDegrees(double rad);

}  // namespace oikos::semantic
