// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace oikos::mapping {

/// Grey images, each half the size of the one before; level 0 is the camera's own size.
/// A pixel (u, v) of level 0 is at ((u + 0.5) / 2^l - 0.5, (v + 0.5) / 2^l - 0.5) in level l.
class ImagePyramid {
 public:
  ImagePyramid() = default;
  /// `gray`: CV_8UC1. Levels end where the smaller side would fall below 24 pixels.
  ImagePyramid(const cv::Mat& gray, int max_levels);

  [[nodiscard]] int levels() const { return static_cast<int>(images_.size()); }
  [[nodiscard]] bool empty() const { return images_.empty(); }
  [[nodiscard]] const cv::Mat& level(int l) const { return images_[static_cast<std::size_t>(l)]; }

 private:
  std::vector<cv::Mat> images_;
};

}  // namespace oikos::mapping
