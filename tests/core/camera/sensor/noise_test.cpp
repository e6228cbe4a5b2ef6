// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/camera/sensor/hash_noise.h"
#include "core/camera/sensor/noise_field.h"
#include "tests/core/camera/sensor/running_moments.h"

namespace oikos::camera {
namespace {

using test::RunningMoments;

TEST(HashNoise, UniformNumbersFillTheInterval) {
  const NoiseStream stream({7, 3, 1}, NoiseUse::kAxial);
  RunningMoments moments;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const float x = toUniform(stream.bits(static_cast<std::uint64_t>(i)));
    ASSERT_TRUE(x >= 0.0F && x < 1.0F);
    moments.add(static_cast<double>(x));
  }
  const double sigma = std::sqrt(1.0 / 12.0);
  EXPECT_NEAR(moments.mean(), 0.5, 4.0 * sigma / std::sqrt(kCount));
  EXPECT_NEAR(moments.deviation(), sigma, 4.0 * sigma / std::sqrt(2.0 * kCount));
}

TEST(HashNoise, GaussianTableHasTheMomentsOfTheNormalDistribution) {
  double sum = 0.0;
  double sum_2 = 0.0;
  double sum_4 = 0.0;
  int within_one = 0;
  for (const float x : gaussianTable()) {
    const auto sq = static_cast<double>(x) * static_cast<double>(x);
    sum += static_cast<double>(x);
    sum_2 += sq;
    sum_4 += sq * sq;
    within_one += sq < 1.0 ? 1 : 0;
  }
  const auto count = static_cast<double>(gaussianTable().size());
  EXPECT_NEAR(sum / count, 0.0, 1e-7);
  EXPECT_NEAR(sum_2 / count, 1.0, 1e-6);
  EXPECT_NEAR(sum_4 / count, 3.0, 0.03);  // the tails end at 3.7
  EXPECT_NEAR(within_one / count, std::erf(std::sqrt(0.5)), 1.5 / count + 1e-3);
}

TEST(HashNoise, SeedFrameAndUseEachGiveOtherNumbers) {
  const NoiseStream stream({7, 3, 1}, NoiseUse::kAxial);
  for (const NoiseStream& other : {NoiseStream({8, 3, 1}, NoiseUse::kAxial), NoiseStream({7, 4, 1}, NoiseUse::kAxial),
                                   NoiseStream({7, 3, 1}, NoiseUse::kSignal), NoiseStream({3, 7, 1}, NoiseUse::kAxial)}) {
    RunningMoments product;
    constexpr int kCount = 20000;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      product.add(static_cast<double>(toGaussian(gaussianTable(), stream.bits(i)) * toGaussian(gaussianTable(), other.bits(i))));
    }
    EXPECT_NEAR(product.mean(), 0.0, 4.0 / std::sqrt(kCount));
  }
  EXPECT_EQ(stream.bits(11), NoiseStream({7, 3, 2}, NoiseUse::kAxial).bits(11));
}

/// Sums over frames of one pixel's noise and of its products with the neighbours on the right.
struct FieldMoments {
  explicit FieldMoments(int spacing_px) {
    std::vector<float> row(kWidth);
    for (int frame = 0; frame < kFrames; ++frame) {
      const NoiseField field({{1, frame, 1}, NoiseUse::kAxial}, {kWidth, kHeight, spacing_px}, 1);
      for (int v = 0; v < kHeight; ++v) {
        field.fillRow(v, row.data());
        for (std::size_t u = 0; u + 2 * static_cast<std::size_t>(spacing_px) < row.size(); ++u) {
          pixel[u % 8].add(static_cast<double>(row[u]));
          beside.add(static_cast<double>(row[u] * row[u + 1]));
          apart.add(static_cast<double>(row[u] * row[u + static_cast<std::size_t>(spacing_px) * 2]));
        }
      }
    }
  }
  static constexpr int kWidth = 64;
  static constexpr int kHeight = 48;
  static constexpr int kFrames = 60;
  RunningMoments pixel[8];
  RunningMoments beside;
  RunningMoments apart;
};

class Field : public testing::TestWithParam<int> {};

TEST_P(Field, HasVarianceOneEverywhereAndIsSmoothOverItsSpacing) {
  const int spacing = GetParam();
  const FieldMoments moments(spacing);
  const double independent = FieldMoments::kWidth / 8.0 * FieldMoments::kHeight * FieldMoments::kFrames / (spacing * spacing);
  for (const RunningMoments& pixel : moments.pixel) {
    EXPECT_NEAR(pixel.mean(), 0.0, 5.0 / std::sqrt(independent));
    EXPECT_NEAR(pixel.deviation(), 1.0, 5.0 / std::sqrt(2.0 * independent));
  }
  if (spacing == 1) {
    EXPECT_NEAR(moments.beside.mean(), 0.0, 0.02);
  } else {
    EXPECT_GT(moments.beside.mean(), 0.5);
  }
  EXPECT_NEAR(moments.apart.mean(), 0.0, 5.0 / std::sqrt(8.0 * independent));
}

INSTANTIATE_TEST_SUITE_P(Spacings, Field, testing::Values(1, 2, 3, 5));

}  // namespace
}  // namespace oikos::camera
