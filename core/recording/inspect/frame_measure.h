// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"

namespace oikos::recording {

/// What the inspection keeps of a frame.
struct FrameMeasure {
  double blur = 0.0;               ///< 0 to 1 along the worse image axis; sharp pictures have about 0.3, smeared ones more than 0.45
  double valid_depth_share = 0.0;  ///< of the pixels
  cv::Mat small_gray;              ///< CV_32FC1, kSmallWidth wide
};
constexpr int kSmallWidth = 128;

[[nodiscard]] FrameMeasure measureFrame(const camera::RgbdFrame& frame);

/// The turn about the image's axes that would explain how the image moved from one frame to the next (phase correlation: Kuglin & Hines,
/// "The Phase Correlation Image Alignment Method", 1975). Shifts of up to half the image are found; a turn about the optical axis is not.
[[nodiscard]] double imageTurnRad(const FrameMeasure& from, const FrameMeasure& to, const camera::PinholeCamera& camera);

}  // namespace oikos::recording
