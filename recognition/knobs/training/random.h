// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace oikos::recognition {

/// Random numbers that are the same with every standard library. Not thread-safe: one for each image, so that their order does not matter.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : engine_(seed * 0x9e3779b97f4a7c15U + stream * 0xbf58476d1ce4e5b9U + 1) {}

  [[nodiscard]] double between(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  [[nodiscard]] bool chance(double probability) { return between(0.0, 1.0) < probability; }
  /// In [0, count).
  [[nodiscard]] int below(int count) { return static_cast<int>(between(0.0, static_cast<double>(count))); }
  [[nodiscard]] double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0)));
    return radius * std::cos(2.0 * std::numbers::pi * between(0.0, 1.0));
  }
  template <class Item>
  [[nodiscard]] const Item& of(const std::vector<Item>& items) {
    return items[static_cast<std::size_t>(below(static_cast<int>(items.size())))];
  }
  [[nodiscard]] std::uint64_t bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace oikos::recognition
