// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace oikos::camera {

/// Fixed-point disparities of a row: fine enough for a fraction of a quantisation step, and small enough that differences fit 16 bits.
constexpr std::int16_t kNoDisparity = -16000;
constexpr std::int16_t kMaxDisparity = 15999;

/// Finds what the projector, on the camera's right, cannot see of a rectified row. A surface at disparity d in column u lies in the
/// projector's column u - d, and the greatest disparity there takes the light. Beside a foreground edge the shadow is as wide as the
/// difference of the two disparities, baseline * f * (1/z_near - 1/z_far), on the left. Scratch memory is kept between rows: not
/// thread-safe.
class ProjectorShadow {
 public:
  ProjectorShadow(int width, float units_per_px);

  /// Sets what lies in shadow to kNoDisparity.
  void darken(std::int16_t* disparities);

 private:
  [[nodiscard]] int projectorColumn(int u, std::int16_t disparity) const;
  void light(const std::int16_t* disparities);

  int width_;
  int offset_px_;  ///< the projector sees columns left of the camera's image too
  float px_per_unit_;
  std::int16_t step_;                  ///< a larger change from pixel to pixel is an edge
  std::vector<std::int16_t> nearest_;  ///< greatest disparity by the projector's column
};

}  // namespace oikos::camera
