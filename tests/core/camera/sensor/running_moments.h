// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace oikos::test {

/// Mean and deviation of numbers of moderate size.
struct RunningMoments {
  void add(double value) {
    ++count;
    sum += value;
    sum_sq += value * value;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double rms() const { return std::sqrt(sum_sq / count); }
  [[nodiscard]] double deviation() const { return std::sqrt(sum_sq / count - mean() * mean()); }

  double count = 0.0;
  double sum = 0.0;
  double sum_sq = 0.0;
};

}  // namespace oikos::test
