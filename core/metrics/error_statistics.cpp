// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oikos::metrics {

namespace {

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) {
    return *middle;
  }
  return 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

}  // namespace

ErrorStatistics statisticsOf(std::vector<double> errors) {
  ErrorStatistics statistics;
  if (errors.empty()) {
    return statistics;
  }
  double sum = 0.0;
  double sum_sq = 0.0;
  for (const double error : errors) {
    sum += error;
    sum_sq += error * error;
    statistics.max = std::max(statistics.max, error);
  }
  const auto count = static_cast<double>(errors.size());
  statistics.count = static_cast<int>(errors.size());
  statistics.mean = sum / count;
  statistics.rmse = std::sqrt(sum_sq / count);
  statistics.median = medianOf(errors);
  return statistics;
}

}  // namespace oikos::metrics
