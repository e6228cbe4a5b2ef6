// SPDX-License-Identifier: Apache-2.0
// Random numbers without a state: each is a function of a key and a counter, so that the order of the work does not matter.
// The mixing function is the finaliser of SplitMix64 (Steele, Lea & Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014,
// doi:10.1145/2660193.2660195).
#pragma once

#include <array>
#include <cstdint>

#include "core/camera/sensor/ideal_view.h"

namespace oikos::camera {

[[nodiscard]] constexpr std::uint64_t mixBits(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// Which of a frame's noises a stream feeds; each has numbers of its own.
enum class NoiseUse : std::uint64_t { kAxial, kLateralAcross, kLateralDown, kSignal, kFlyingPixel, kColor };

/// 64 random bits for each counter, such as the index of a pixel.
class NoiseStream {
 public:
  constexpr NoiseStream(const SensorRun& run, NoiseUse use)
      : key_(mixBits(mixBits(mixBits(run.seed + kStep) + static_cast<std::uint64_t>(run.frame) * kStep) +
                     (static_cast<std::uint64_t>(use) + 1) * kStep)) {}

  [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t counter) const { return mixBits(key_ + (counter + 1) * kStep); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15U;
  std::uint64_t key_;
};

/// In [0, 1), from the upper 24 bits.
[[nodiscard]] constexpr float toUniform(std::uint64_t bits) {
  return static_cast<float>(bits >> 40U) * 0x1p-24F;
}

/// Standard normal numbers for twelve bits each, many times faster than a formula with logarithms: quantiles at the middle of 4096 equal
/// shares, scaled to variance 1 exactly. No number is beyond 3.7.
constexpr unsigned kGaussianTableBits = 12;
using GaussianTable = std::array<float, 1U << kGaussianTableBits>;
[[nodiscard]] const GaussianTable& gaussianTable();

/// The number for the lowest twelve bits.
[[nodiscard]] inline float toGaussian(const GaussianTable& table, std::uint64_t bits) {
  return table[bits & (table.size() - 1)];
}

}  // namespace oikos::camera
