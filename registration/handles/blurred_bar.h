// SPDX-License-Identifier: Apache-2.0
// A grip before its front, as a depth camera shows it that takes the mean over a square of pixels. Included by this folder's sources and
// tests only.
#pragma once

#include <Eigen/Core>

namespace oikos::registration {

using BarVector = Eigen::Matrix<double, 8, 1>;  ///< in the order of Bar
using BarMatrix = Eigen::Matrix<double, 8, 8>;

/// A rectangle that stands out of a plane: in the plane of the believed grip, y across it and z along it.
struct Bar {
  double along_m = 0.0;   ///< z of its middle
  double across_m = 0.0;  ///< y of its middle
  double roll_rad = 0.0;  ///< about x
  double height_m = 0.0;  ///< before the plane
  double offset_m = 0.0;  ///< of the plane
  double half_length_m = 0.0;
  double half_width_m = 0.0;
  double blur_m = 0.0;  ///< half a side of the square that the camera takes the mean over

  [[nodiscard]] BarVector vector() const;
  [[nodiscard]] static Bar from(const BarVector& vector);
};

/// Share of an interval of `blur_m` to both sides of x that lies within `half_m` of 0.
[[nodiscard]] inline double covered(double x_m, double half_m, double blur_m) {
  const double high = x_m + blur_m < half_m ? x_m + blur_m : half_m;
  const double low = x_m - blur_m > -half_m ? x_m - blur_m : -half_m;
  return high > low ? (high - low) / (2.0 * blur_m) : 0.0;
}

/// What the camera reads at a place, and its derivatives.
struct BarReading {
  double height_m = 0.0;
  double cover = 0.0;                        ///< 0 beside the bar, 1 where nothing else is seen
  BarVector derivative = BarVector::Zero();  ///< in the order of Bar
};

/// A bar to be read at many places.
class BlurredBar {
 public:
  explicit BlurredBar(const Bar& bar);
  [[nodiscard]] BarReading at(double along_m, double across_m) const;

 private:
  Bar bar_;
  double cos_roll_;
  double sin_roll_;
};

}  // namespace oikos::registration
