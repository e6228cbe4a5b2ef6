// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

namespace oikos::simulate {
namespace {

constexpr int kSize_px = 256;

class Textures : public testing::TestWithParam<TextureKind> {};

bool areEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

/// Mean absolute difference of two columns, or of two rows.
double stepBetween(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

TEST_P(Textures, HaveTheSizeAskedFor) {
  for (const int size_px : {64, kSize_px}) {
    const cv::Mat texture = makeTexture(GetParam(), 3, size_px);
    EXPECT_EQ(texture.type(), CV_8UC3);
    EXPECT_EQ(texture.size(), cv::Size(size_px, size_px));
  }
}

TEST_P(Textures, ComeFromTheirSeed) {
  const cv::Mat texture = makeTexture(GetParam(), 3, kSize_px);
  EXPECT_TRUE(areEqual(texture, makeTexture(GetParam(), 3, kSize_px)));
  EXPECT_FALSE(areEqual(texture, makeTexture(GetParam(), 4, kSize_px)));
  EXPECT_FALSE(areEqual(texture, makeTexture(GetParam(), std::uint64_t{1} << 63U, kSize_px)));
}

TEST_P(Textures, ShowSomething) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(makeTexture(GetParam(), 3, kSize_px), mean, deviation);
  EXPECT_GT(deviation[0], GetParam() == TextureKind::kBrushedMetal ? 2.0 : 4.0);
  EXPECT_GT(mean[0], 20.0);
}

TEST_P(Textures, AreSeamless) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const cv::Mat texture = makeTexture(GetParam(), seed, kSize_px);
    double greatest_across = 0.0;
    double greatest_down = 0.0;
    for (int i = 1; i < kSize_px; ++i) {
      greatest_across = std::max(greatest_across, stepBetween(texture.col(i - 1), texture.col(i)));
      greatest_down = std::max(greatest_down, stepBetween(texture.row(i - 1), texture.row(i)));
    }
    EXPECT_LE(stepBetween(texture.col(kSize_px - 1), texture.col(0)), 1.1 * greatest_across) << "seed " << seed;
    EXPECT_LE(stepBetween(texture.row(kSize_px - 1), texture.row(0)), 1.1 * greatest_down) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, Textures,
                         testing::Values(TextureKind::kWood, TextureKind::kPlanks, TextureKind::kTiles, TextureKind::kPlaster,
                                         TextureKind::kWallpaper, TextureKind::kFabric, TextureKind::kStone, TextureKind::kBrushedMetal,
                                         TextureKind::kPainting, TextureKind::kPrint),
                         [](const auto& kind) { return std::string(base::toString(kind.param)); });

TEST(MakeTexture, KindsDiffer) {
  EXPECT_FALSE(areEqual(makeTexture(TextureKind::kPlaster, 1, 64), makeTexture(TextureKind::kWallpaper, 1, 64)));
}

}  // namespace
}  // namespace oikos::simulate
