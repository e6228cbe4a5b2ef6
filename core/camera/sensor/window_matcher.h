// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/camera/sensor/projector_shadow.h"

namespace oikos::camera {

/// Side of the square of pixels that a structured-light sensor correlates with its pattern.
constexpr int kMatchWindow_px = 9;
constexpr int kMatchRadius_px = kMatchWindow_px / 2;
/// Columns right of a disparity image that must be readable memory: windows are read in whole vectors.
constexpr int kMatchPadding_px = 16;

struct MatchRules {
  std::int16_t agreement = 0;  ///< pixels that differ by no more match together
  int min_count = 0;           ///< of the window's 81 pixels
};

/// What a window of an image sees if it holds no edge.
struct SmoothWindows {
  explicit SmoothWindows(int width);
  /// For all columns whose window around row v lies inside the image. `disparities`: CV_16SC1.
  void fill(const cv::Mat& disparities, int v);
  [[nodiscard]] bool isSmooth(int u, const MatchRules& rules) const { return high[index(u)] - low[index(u)] <= 2 * rules.agreement; }
  [[nodiscard]] float mean(int u) const { return static_cast<float>(sum[index(u)]) / (kMatchWindow_px * kMatchWindow_px); }

  static std::size_t index(int u) { return static_cast<std::size_t>(u); }
  std::vector<std::int16_t> low, high, column_low, column_high;
  std::vector<std::int32_t> sum, column_sum;
};

/// The disparity on which most of the window around (u, v) agrees: the mean of the largest group of pixels within the rules' agreement.
/// `disparities`: CV_16SC1, padded. kNoDisparity if the group is too small, or if the pixel in the middle has no light.
[[nodiscard]] float matchWindow(const cv::Mat& disparities, int u, int v, const MatchRules& rules);

}  // namespace oikos::camera
