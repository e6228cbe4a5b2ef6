// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/share_interval.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace oikos::metrics {

ShareInterval wilsonInterval(int hits, int count) {
  OIKOS_CHECK(count >= 0 && hits >= 0 && hits <= count);
  if (count == 0) {
    return {};
  }
  constexpr double kZ = 1.959963984540054;
  const double share = static_cast<double>(hits) / count;
  const double scale = 1.0 + kZ * kZ / count;
  const double middle = (share + kZ * kZ / (2.0 * count)) / scale;
  const double half = kZ / scale * std::sqrt(share * (1.0 - share) / count + kZ * kZ / (4.0 * count * count));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace oikos::metrics
