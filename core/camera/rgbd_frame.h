// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace oikos::camera {

/// One image pair as every method sees it: free of lens distortion, depth registered to the colour camera pixel by pixel.
struct RgbdFrame {
  int index = -1;             ///< position in the recording's list of frames, gaps included
  std::int64_t stamp_ns = 0;  ///< of the colour image
  cv::Mat gray;               ///< CV_8UC1
  cv::Mat color;              ///< CV_8UC3, BGR; empty unless colour was asked for
  cv::Mat depth_m;            ///< CV_32FC1, metres along the optical axis; NaN = no reading
};

}  // namespace oikos::camera
