// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/window_matcher.h"

#include <algorithm>
#include <cstdlib>

namespace oikos::camera {

namespace {

constexpr int kStride = kMatchPadding_px;  // window rows are padded to a whole vector
constexpr int kMaxSurfaces = 4;            // tried in a window before it counts as clutter
constexpr int kMajority = kMatchWindow_px * kMatchWindow_px / 2 + 1;

using Window = std::array<std::int16_t, kMatchWindow_px * kStride>;

/// Which of a vector's numbers belong to the window, as bits, so that it is read at once.
struct Lanes {
  std::int16_t keep[kStride] = {};
  std::int16_t otherwise[kStride] = {};
};
constexpr Lanes kLanes = [] {
  Lanes lanes;
  for (int i = 0; i < kStride; ++i) {
    lanes.keep[i] = i < kMatchWindow_px ? -1 : 0;
    lanes.otherwise[i] = i < kMatchWindow_px ? 0 : kNoDisparity;
  }
  return lanes;
}();

void copyWindow(const cv::Mat& disparities, int u, int v, Window& window) {
  auto* to = window.data();
  for (int row = 0; row < kMatchWindow_px; ++row) {
    const auto* from = disparities.ptr<std::int16_t>(v - kMatchRadius_px + row) + u - kMatchRadius_px;
    for (int i = 0; i < kStride; ++i) {
      to[i] = static_cast<std::int16_t>((from[i] & kLanes.keep[i]) | kLanes.otherwise[i]);
    }
    to += kStride;
  }
}

struct Group {
  int count = 0;
  float mean = kNoDisparity;
};

/// 16-bit sums, since that is one vector a row; 81 differences within the agreement fit.
Group gather(const Window& window, std::int16_t middle, std::int16_t agreement) {
  std::int16_t count = 0;
  std::int16_t sum = 0;
  for (const std::int16_t value : window) {
    const auto difference = static_cast<std::int16_t>(value - middle);
    const bool agrees = difference <= agreement && difference >= -agreement;
    count = static_cast<std::int16_t>(count + (agrees ? 1 : 0));
    sum = static_cast<std::int16_t>(sum + (agrees ? difference : 0));
  }
  return {count, count > 0 ? static_cast<float>(middle) + static_cast<float>(sum) / static_cast<float>(count) : kNoDisparity};
}

/// The first pixel of the window that belongs to none of the groups so far.
std::int16_t findSeed(const Window& window, const std::array<Group, kMaxSurfaces>& groups, int group_count, std::int16_t agreement) {
  for (const std::int16_t value : window) {
    bool is_new = value != kNoDisparity;
    for (int i = 0; i < group_count && is_new; ++i) {
      is_new = std::abs(static_cast<float>(value) - groups[static_cast<std::size_t>(i)].mean) > static_cast<float>(agreement);
    }
    if (is_new) {
      return value;
    }
  }
  return kNoDisparity;
}

Group findLargestGroup(const Window& window, const Group& middle, std::int16_t agreement) {
  std::array<Group, kMaxSurfaces> groups{middle};
  Group largest = middle;
  for (int i = 1; i < kMaxSurfaces; ++i) {
    const std::int16_t seed = findSeed(window, groups, i, agreement);
    if (seed == kNoDisparity) {
      break;
    }
    const Group around_seed = gather(window, seed, agreement);
    const Group group = gather(window, static_cast<std::int16_t>(around_seed.mean), agreement);
    groups[static_cast<std::size_t>(i)] = group.count > 0 ? group : around_seed;
    if (group.count > largest.count) {
      largest = group;
    }
  }
  return largest;
}

}  // namespace

SmoothWindows::SmoothWindows(int width)
    : low(index(width)), high(low), column_low(low), column_high(low), sum(index(width)), column_sum(index(width)) {}

void SmoothWindows::fill(const cv::Mat& disparities, int v) {
  const int width = disparities.cols;
  std::fill(column_low.begin(), column_low.end(), kMaxDisparity);
  std::fill(column_high.begin(), column_high.end(), kNoDisparity);
  std::fill(column_sum.begin(), column_sum.end(), 0);
  std::int16_t* __restrict of_column_low = column_low.data();
  std::int16_t* __restrict of_column_high = column_high.data();
  std::int32_t* __restrict of_column_sum = column_sum.data();
  for (int row = v - kMatchRadius_px; row <= v + kMatchRadius_px; ++row) {
    const auto* __restrict values = disparities.ptr<std::int16_t>(row);
    for (int u = 0; u < width; ++u) {
      of_column_low[u] = std::min(of_column_low[u], values[u]);
      of_column_high[u] = std::max(of_column_high[u], values[u]);
      of_column_sum[u] += values[u];
    }
  }
  std::int16_t* __restrict of_low = low.data();
  std::int16_t* __restrict of_high = high.data();
  std::int32_t* __restrict of_sum = sum.data();
  std::fill(low.begin(), low.end(), kMaxDisparity);
  std::fill(high.begin(), high.end(), kNoDisparity);
  std::fill(sum.begin(), sum.end(), 0);
  for (int shift = -kMatchRadius_px; shift <= kMatchRadius_px; ++shift) {
    for (int u = kMatchRadius_px; u < width - kMatchRadius_px; ++u) {
      of_low[u] = std::min(of_low[u], of_column_low[u + shift]);
      of_high[u] = std::max(of_high[u], of_column_high[u + shift]);
      of_sum[u] += of_column_sum[u + shift];
    }
  }
}

float matchWindow(const cv::Mat& disparities, int u, int v, const MatchRules& rules) {
  const std::int16_t middle = disparities.ptr<std::int16_t>(v)[u];
  if (middle == kNoDisparity) {
    return kNoDisparity;
  }
  Window window;
  copyWindow(disparities, u, v, window);
  const Group of_middle = gather(window, middle, rules.agreement);
  const Group largest = of_middle.count >= kMajority ? of_middle : findLargestGroup(window, of_middle, rules.agreement);
  return largest.count >= rules.min_count ? largest.mean : static_cast<float>(kNoDisparity);
}

}  // namespace oikos::camera
