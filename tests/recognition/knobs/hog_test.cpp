// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/hog.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>

namespace oikos::recognition {
namespace {

cv::Mat imageOf(int side, const std::function<float(int, int)>& value) {
  cv::Mat image(side, side, CV_32FC1);
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      image.at<float>(v, u) = value(u, v);
    }
  }
  return image;
}

/// Ever brighter towards a direction.
cv::Mat ramp(int side, double towards_rad) {
  return imageOf(side, [&](int u, int v) { return static_cast<float>(0.01 * (u * std::cos(towards_rad) + v * std::sin(towards_rad))); });
}

TEST(Hog, GradientsOfARampAreItsSlopeAndDirection) {
  const Gradients gradients = differentiate(ramp(20, 0.6));
  EXPECT_NEAR(gradients.magnitude.at<float>(9, 7), 0.02, 1e-6);  // over two pixels
  EXPECT_NEAR(gradients.orientation.at<float>(9, 7) * std::numbers::pi, 0.6, 0.01);
  EXPECT_EQ(gradients.magnitude.at<float>(0, 7), 0.0F);
}

TEST(Hog, BrighterAndDarkerAreTheSame) {
  const cv::Mat image = ramp(24, 1.1);
  const HogCells one = histogramCells(differentiate(image), {6, 9});
  const HogCells other = histogramCells(differentiate(-image), {6, 9});
  ASSERT_EQ(one.values.size(), other.values.size());
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    EXPECT_NEAR(one.values[i], other.values[i], 1e-5);
  }
}

TEST(Hog, OfThreeChannelsTheSteepestCounts) {
  const cv::Mat flat = cv::Mat::zeros(12, 12, CV_32FC1);
  cv::Mat color;
  cv::merge(std::vector<cv::Mat>{flat, ramp(12, 0.0), 0.5 * ramp(12, std::numbers::pi / 2.0)}, color);
  const Gradients gradients = differentiate(color);
  EXPECT_NEAR(gradients.magnitude.at<float>(5, 5), 0.02, 1e-6);
  EXPECT_NEAR(gradients.orientation.at<float>(5, 5), 0.0, 1e-3);
}

TEST(Hog, EveryGradientIsSharedOutOnce) {
  // Nothing lies within half a cell of the border, where shares fall beside the cells.
  const Gradients gradients = differentiate(imageOf(36, [](int u, int v) { return u > 9 && u < 26 && v > 9 && v < 26 ? 1.0F : 0.0F; }));
  const HogCells cells = histogramCells(gradients, {6, 9});
  EXPECT_NEAR(std::accumulate(cells.values.begin(), cells.values.end(), 0.0), cv::sum(gradients.magnitude)[0], 1e-3);
}

TEST(Hog, BlocksLeaveOutTheBorderAndAreTruncated) {
  const cv::Mat image = imageOf(48, [](int u, int v) { return (u / 5 + v / 7) % 2 == 0 ? 0.0F : 1.0F; });
  const HogCells cells = normaliseByBlocks(histogramCells(differentiate(image), {6, 9}));
  EXPECT_EQ(cells.columns, 6);
  EXPECT_EQ(cells.rows, 6);
  ASSERT_EQ(cells.values.size(), 6U * 6U * 9U);
  float greatest = 0.0F;
  for (const float value : cells.values) {
    EXPECT_GE(value, 0.0F);
    greatest = std::max(greatest, value);
  }
  EXPECT_LE(greatest, 0.2F);
  EXPECT_GT(greatest, 0.15F);
}

TEST(Hog, NothingToSeeIsNothing) {
  const HogCells cells = normaliseByBlocks(histogramCells(differentiate(cv::Mat(24, 24, CV_32FC1, 0.4F)), {6, 9}));
  for (const float value : cells.values) {
    EXPECT_EQ(value, 0.0F);
  }
}

TEST(Hog, AsAWholeHasLengthOne) {
  const cv::Mat image = imageOf(48, [](int u, int) { return u > 20 ? 1.0F : 0.0F; });
  const HogCells cells = normaliseAsWhole(histogramCells(differentiate(image), {12, 36}));
  EXPECT_EQ(cells.values.size(), 4U * 4U * 36U);
  EXPECT_NEAR(std::inner_product(cells.values.begin(), cells.values.end(), cells.values.begin(), 0.0), 1.0, 1e-3);
}

}  // namespace
}  // namespace oikos::recognition
