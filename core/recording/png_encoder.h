// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace oikos::recording {

/// A PNG of CV_8UC3 (BGR), CV_8UC4 (BGRA) or CV_16UC1 pixels as they are, without a colour space; `level` from 0 (stored) over 1 (fast) to
/// 9 (small) is zlib's scale. Every level decodes to the same pixels. Thread-safe.
[[nodiscard]] std::vector<unsigned char> encodePng(const cv::Mat& image, int level);

}  // namespace oikos::recording
