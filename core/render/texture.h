// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace oikos::render {

/// sRGB (IEC 61966-2-1) to linear light and back.
[[nodiscard]] float linearOf(std::uint8_t srgb);
[[nodiscard]] float linearOf(float srgb);
[[nodiscard]] std::uint8_t srgbOf(float linear);

/// A texture with its means over 2, 4, 8, … pixels (Williams, "Pyramidal Parametrics", SIGGRAPH 1983), so that what is far away does not
/// flicker. Repeats itself beyond its borders. Immutable, so thread-safe.
class TexturePyramid {
 public:
  /// `texture`: CV_8UC3, BGR, not empty.
  explicit TexturePyramid(const cv::Mat& texture);

  /// Linear RGB at a texture coordinate, (0, 0) the lower left corner. `footprint_px`: how many texture pixels an image pixel covers.
  [[nodiscard]] Eigen::Vector3f at(const Eigen::Vector2f& coordinate, float footprint_px) const;
  [[nodiscard]] float width() const { return static_cast<float>(levels_.front().cols); }
  [[nodiscard]] float height() const { return static_cast<float>(levels_.front().rows); }

 private:
  std::vector<cv::Mat> levels_;
};

}  // namespace oikos::render
