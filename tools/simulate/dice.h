// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/camera/sensor/hash_noise.h"

namespace oikos::simulate {

/// Random numbers from a seed: one after the other, or by where and what for. The same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(camera::mixBits(seed + 0x9e3779b97f4a7c15U)) {}

  /// In [0, 1), by three numbers.
  [[nodiscard]] double at(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const {
    return camera::toUniform(
        camera::mixBits(camera::mixBits(camera::mixBits(seed_ + a) + b * 0x51ed270b35ae5b11U) + c * 0xd1342543de82ef95U));
  }
  /// The next in [0, 1).
  [[nodiscard]] double next() { return at(1'000'000 + used_++, 1, 1); }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * next(); }
  [[nodiscard]] int upTo(int most) { return static_cast<int>(next() * (most + 1)); }
  /// Of the standard normal distribution (Box & Muller 1958).
  [[nodiscard]] double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - next()));
    return radius * std::cos(2.0 * std::numbers::pi * next());
  }

 private:
  std::uint64_t seed_;
  std::uint64_t used_ = 0;
};

}  // namespace oikos::simulate
