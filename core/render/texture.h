// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace oikos::render {

/// A texture with its means over 2, 4, 8, … pixels (Williams, "Pyramidal Parametrics", SIGGRAPH 1983), so that what is far away does not
/// flicker. Repeats itself beyond its borders. Kept as light, not as stored bytes, in 16 bits; one without colours as one channel.
/// Immutable, so thread-safe.
class TexturePyramid {
 public:
  /// `texture`: CV_8UC3, BGR, not empty; it is not needed afterwards.
  explicit TexturePyramid(const cv::Mat& texture);

  /// Light, RGB, at a texture coordinate, (0, 0) the lower left corner. `footprint_px`: how many texture pixels an image pixel covers.
  [[nodiscard]] Eigen::Array3f at(const Eigen::Vector2f& coordinate, float footprint_px) const;

 private:
  /// One column more on the right and one row more below: the first ones again.
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> texels;
  };
  void addLevel(const cv::Mat& light);

  int channels_ = 1;  ///< 1 or 4
  std::vector<Level> levels_;
};

}  // namespace oikos::render
