// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace oikos::simulate {

/// That a sample of `independent` draws has the mean 0 and this deviation, each within four standard errors. `independent`: fewer than the
/// sample's size if neighbours resemble each other.
inline void expectGaussianSample(const std::vector<double>& sample, double sigma, double independent) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : sample) {
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(sample.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 * sigma / std::sqrt(independent));
  EXPECT_NEAR(std::sqrt(squares / n), sigma, 4.0 * sigma / std::sqrt(2.0 * independent));
}

inline void expectGaussianSample(const std::vector<double>& sample, double sigma) {
  expectGaussianSample(sample, sigma, static_cast<double>(sample.size()));
}

}  // namespace oikos::simulate
