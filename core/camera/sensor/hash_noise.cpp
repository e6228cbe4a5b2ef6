// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/hash_noise.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace oikos::camera {

namespace {

/// Newton's method on the normal distribution function, from the neighbouring quantile.
double findQuantile(double probability, double start) {
  double x = start;
  for (int i = 0; i < 8; ++i) {
    const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    x -= (below - probability) / density;
  }
  return x;
}

GaussianTable makeGaussianTable() {
  GaussianTable table{};
  constexpr std::size_t kHalf = std::tuple_size_v<GaussianTable> / 2;
  std::array<double, kHalf> quantiles{};
  double x = 0.0;
  double sum_sq = 0.0;
  for (std::size_t i = 0; i < kHalf; ++i) {
    x = findQuantile(0.5 + (static_cast<double>(i) + 0.5) / static_cast<double>(table.size()), x);
    quantiles[i] = x;
    sum_sq += x * x;
  }
  const double scale = 1.0 / std::sqrt(sum_sq / static_cast<double>(kHalf));
  for (std::size_t i = 0; i < kHalf; ++i) {
    table[kHalf + i] = static_cast<float>(quantiles[i] * scale);
    table[kHalf - 1 - i] = -table[kHalf + i];
  }
  return table;
}

}  // namespace

const GaussianTable& gaussianTable() {
  static const GaussianTable kTable = makeGaussianTable();
  return kTable;
}

}  // namespace oikos::camera
