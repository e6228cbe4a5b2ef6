// SPDX-License-Identifier: Apache-2.0
// How sure a share is that was counted.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace oikos::bench {

/// Wilson's interval at 95 % for `hits` of `count` (Wilson 1927, doi:10.1080/01621459.1927.10502953); within 0 to 1.
[[nodiscard]] inline std::array<double, 2> wilsonInterval(int hits, int count) {
  constexpr double kZ = 1.96;
  const double n = std::max(1, count);
  const double p = hits / n;
  const double middle = (p + kZ * kZ / (2.0 * n)) / (1.0 + kZ * kZ / n);
  const double half = kZ / (1.0 + kZ * kZ / n) * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace oikos::bench
