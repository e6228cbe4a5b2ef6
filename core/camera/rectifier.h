// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/calibration.h"

namespace oikos::camera {

/// Takes the lens distortion out of images of one camera: the result is a pure pinhole with the same size, fx, fy, cx, cy.
/// Tables are computed once; without distortion nothing is resampled. Immutable, so thread-safe.
class Rectifier {
 public:
  Rectifier(const PinholeCamera& camera, const LensDistortion& distortion);

  [[nodiscard]] bool isIdentity() const { return source_index_.empty(); }
  /// CV_8UC1 or CV_8UC3 of the camera's size, bilinear; pixels that the lens did not see are 0.
  [[nodiscard]] cv::Mat rectifyColor(const cv::Mat& image) const;
  /// For each rectified pixel (row-major) the stored pixel that it falls into, -1 outside; empty if isIdentity().
  [[nodiscard]] const std::vector<std::int32_t>& sourceIndex() const { return source_index_; }

 private:
  cv::Mat map_px_;        ///< CV_16SC2: whole pixels
  cv::Mat map_fraction_;  ///< CV_16UC1: OpenCV's index of the fraction, 1/32 px
  std::vector<std::int32_t> source_index_;
};

}  // namespace oikos::camera
