// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "recognition/knobs/training/panel.h"

namespace oikos::recognition {

constexpr float kPanelWidth_m = 0.5F;
constexpr float kPanelHeight_m = 0.25F;
constexpr int kPrintPixelsPerMetre = 1024;

/// What is printed on a panel: scales around the knobs, digits, symbols, a name. CV_8UC3, BGR, on a ground of `ground`.
[[nodiscard]] cv::Mat printPanel(const std::vector<DrawnKnob>& knobs, const cv::Mat& ground, Random& random);

}  // namespace oikos::recognition
