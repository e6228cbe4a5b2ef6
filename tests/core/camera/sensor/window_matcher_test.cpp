// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/window_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <vector>

#include "core/camera/sensor/hash_noise.h"
#include "core/camera/sensor/projector_shadow.h"

namespace oikos::camera {
namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 24;
constexpr MatchRules kRules = {100, 37};

/// Disparities at random: a slope, patches of other disparities, and pixels without light.
cv::Mat randomDisparities(std::uint64_t seed, int patches) {
  const cv::Mat padded(kHeight, kWidth + kMatchPadding_px, CV_16SC1, cv::Scalar(kNoDisparity));
  cv::Mat disparities = padded.colRange(0, kWidth);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      disparities.at<std::int16_t>(v, u) = static_cast<std::int16_t>(3000 + 7 * u - 3 * v);
    }
  }
  const NoiseStream stream({seed, 0, 1}, NoiseUse::kSignal);
  for (int i = 0; i < patches; ++i) {
    const std::uint64_t bits = stream.bits(static_cast<std::uint64_t>(i));
    const cv::Rect patch(static_cast<int>(bits % 50), static_cast<int>((bits >> 8U) % 18), static_cast<int>(1 + (bits >> 16U) % 10),
                         static_cast<int>(1 + (bits >> 24U) % 6));
    const int value = i % 4 == 3 ? kNoDisparity : static_cast<int>(3000 + (bits >> 32U) % 2000);
    disparities(patch) = cv::Scalar(value);
  }
  return disparities;
}

std::vector<int> windowAround(const cv::Mat& disparities, int u, int v) {
  std::vector<int> values;
  for (int dv = -kMatchRadius_px; dv <= kMatchRadius_px; ++dv) {
    for (int du = -kMatchRadius_px; du <= kMatchRadius_px; ++du) {
      values.push_back(disparities.at<std::int16_t>(v + dv, u + du));
    }
  }
  return values;
}

int countNear(const std::vector<int>& values, double middle) {
  int count = 0;
  for (const int value : values) {
    count += value != kNoDisparity && std::abs(value - middle) <= kRules.agreement ? 1 : 0;
  }
  return count;
}

TEST(SmoothWindows, AreTheExtremesAndTheMeanOfEachWindow) {
  const cv::Mat disparities = randomDisparities(1, 10);
  SmoothWindows windows(kWidth);
  for (int v = kMatchRadius_px; v < kHeight - kMatchRadius_px; ++v) {
    windows.fill(disparities, v);
    for (int u = kMatchRadius_px; u < kWidth - kMatchRadius_px; ++u) {
      const std::vector<int> values = windowAround(disparities, u, v);
      double sum = 0.0;
      for (const int value : values) {
        sum += value;
      }
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      ASSERT_EQ(windows.low[SmoothWindows::index(u)], *low);
      ASSERT_EQ(windows.high[SmoothWindows::index(u)], *high);
      ASSERT_NEAR(windows.mean(u), sum / 81.0, 0.01);
      if (*high - *low <= kRules.agreement && *high != kNoDisparity) {
        ASSERT_TRUE(windows.isSmooth(u, kRules));
        ASSERT_NEAR(matchWindow(disparities, u, v, kRules), sum / 81.0, 0.01);
      }
    }
  }
}

TEST(MatchWindow, FindsAGroupThatAgreesAndNoneWhereNoDisparityHasEnough) {
  int matched = 0;
  int lost = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const cv::Mat disparities = randomDisparities(seed, 40);
    for (int v = kMatchRadius_px; v < kHeight - kMatchRadius_px; ++v) {
      for (int u = kMatchRadius_px; u < kWidth - kMatchRadius_px; ++u) {
        const float match = matchWindow(disparities, u, v, kRules);
        const std::vector<int> values = windowAround(disparities, u, v);
        if (match != kNoDisparity) {
          ASSERT_GE(countNear(values, static_cast<double>(match)), kRules.min_count - 6);  // the mean moves the group's limits a little
          ++matched;
          continue;
        }
        ++lost;
        if (disparities.at<std::int16_t>(v, u) != kNoDisparity) {
          ASSERT_LT(countNear(values, disparities.at<std::int16_t>(v, u)), kRules.min_count);
        }
      }
    }
  }
  EXPECT_GT(matched, 1000);
  EXPECT_GT(lost, 1000);
}

TEST(ProjectorShadow, IsWhatASurfaceOnTheRightHidesFromTheProjector) {
  constexpr float kUnits = 100.0F;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const cv::Mat disparities = randomDisparities(seed, 25);
    std::vector<std::int16_t> row(disparities.ptr<std::int16_t>(12), disparities.ptr<std::int16_t>(12) + kWidth);
    const std::vector<std::int16_t> before = row;
    ProjectorShadow(kWidth, kUnits).darken(row.data());
    for (int u = 0; u < kWidth; ++u) {
      // at most half a pixel of each of the two rays is lost by whole columns
      double nearest_px = 1e9;
      const auto column = [&](int at) { return at - static_cast<double>(before[SmoothWindows::index(at)]) / static_cast<double>(kUnits); };
      const std::int16_t here = before[SmoothWindows::index(u)];
      for (int other = 0; other < kWidth; ++other) {
        if (before[SmoothWindows::index(other)] > here + static_cast<int>(kUnits)) {
          nearest_px = std::min(nearest_px, std::abs(column(other) - column(u)));
        }
      }
      if (here == kNoDisparity) {
        continue;
      }
      if (nearest_px > 1.01) {
        ASSERT_NE(row[SmoothWindows::index(u)], kNoDisparity) << "lit: " << u;
      }
      if (nearest_px < 1e-6) {
        ASSERT_EQ(row[SmoothWindows::index(u)], kNoDisparity) << "dark: " << u;
      }
    }
  }
}

}  // namespace
}  // namespace oikos::camera
