// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace oikos::metrics {

/// Of a set of errors >= 0; the unit is the errors' own and stands in the name of the variable. All zero when there are none.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  ///< of an even number: the mean of the middle two
  double max = 0.0;
};

/// Sums in the order given, so that equal input gives equal bits.
[[nodiscard]] ErrorStatistics statisticsOf(std::vector<double> errors);

}  // namespace oikos::metrics
