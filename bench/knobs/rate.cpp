// SPDX-License-Identifier: Apache-2.0
#include "bench/knobs/rate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace oikos::bench {

std::pair<double, double> rateInterval(long successes, long n) {
  const double z = 1.96;
  const auto count = static_cast<double>(n);
  const double p = static_cast<double>(successes) / count;
  const double middle = (p + z * z / (2.0 * count)) / (1.0 + z * z / count);
  const double half = z / (1.0 + z * z / count) * std::sqrt(p * (1.0 - p) / count + z * z / (4.0 * count * count));
  return {middle - half, middle + half};
}

std::string rateText(long successes, long n) {
  char text[100];
  const long count = std::max(1L, n);
  const auto [low, high] = rateInterval(successes, count);
  std::snprintf(text, sizeof text, "%.2f %% (%ld of %ld; %.2f to %.2f)",
                100.0 * static_cast<double>(successes) / static_cast<double>(count), successes, n, 100.0 * std::max(0.0, low),
                100.0 * high);
  return text;
}

std::string meanText(const std::vector<double>& values) {
  const auto n = static_cast<double>(std::max<std::size_t>(1, values.size()));
  double mean = 0.0;
  for (const double value : values) {
    mean += value / n;
  }
  double variance = 0.0;
  for (const double value : values) {
    variance += (value - mean) * (value - mean) / n;
  }
  char text[60];
  std::snprintf(text, sizeof text, "%.2f +- %.2f", mean, 1.96 * std::sqrt(variance / n));
  return text;
}

}  // namespace oikos::bench
