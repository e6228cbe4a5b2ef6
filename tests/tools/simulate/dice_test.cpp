// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/dice.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/tools/simulate/statistics.h"

namespace oikos::simulate {
namespace {

TEST(Dice, IsGaussian) {
  Dice dice(7);
  std::vector<double> sample;
  int beyond_two = 0;
  constexpr int kCount = 20'000;
  for (int i = 0; i < kCount; ++i) {
    sample.push_back(dice.gaussian());
    beyond_two += std::abs(sample.back()) > 2.0 ? 1 : 0;
  }
  expectGaussianSample(sample, 1.0);
  EXPECT_NEAR(beyond_two / static_cast<double>(kCount), 0.0455, 4.0 * std::sqrt(0.0455 / kCount));
}

TEST(Dice, IsEvenAcrossNeighbouringSeeds) {
  std::vector<double> sample;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    sample.push_back(Dice(seed).next() - 0.5);
  }
  expectGaussianSample(sample, std::sqrt(1.0 / 12.0));
}

TEST(Dice, ReachesBothEndsOfARange) {
  Dice dice(1);
  std::vector<int> counts(4);
  for (int i = 0; i < 4000; ++i) {
    ++counts.at(static_cast<std::size_t>(dice.upTo(3)));
  }
  for (const int count : counts) {
    EXPECT_NEAR(count, 1000.0, 4.0 * std::sqrt(4000.0 * 0.25 * 0.75));
  }
}

}  // namespace
}  // namespace oikos::simulate
