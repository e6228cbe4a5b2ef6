// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/blurred_bar.h"

#include <cmath>

namespace oikos::registration {

namespace {

/// covered() and its derivatives.
struct Cover {
  double value = 0.0;
  double by_x = 0.0;
  double by_half = 0.0;
  double by_blur = 0.0;
};

Cover coverOf(double x_m, double half_m, double blur_m) {
  const double value = covered(x_m, half_m, blur_m);
  if (value <= 0.0) {
    return {};
  }
  const double high_moves = x_m + blur_m < half_m ? 1.0 : 0.0;
  const double low_moves = x_m - blur_m > -half_m ? 1.0 : 0.0;
  return {value, (high_moves - low_moves) / (2.0 * blur_m), (2.0 - high_moves - low_moves) / (2.0 * blur_m),
          ((high_moves + low_moves) / 2.0 - value) / blur_m};
}

}  // namespace

BarVector Bar::vector() const {
  return (BarVector() << along_m, across_m, roll_rad, height_m, offset_m, half_length_m, half_width_m, blur_m).finished();
}

Bar Bar::from(const BarVector& vector) {
  return {vector[0], vector[1], vector[2], vector[3], vector[4], vector[5], vector[6], vector[7]};
}

BlurredBar::BlurredBar(const Bar& bar) : bar_(bar), cos_roll_(std::cos(bar.roll_rad)), sin_roll_(std::sin(bar.roll_rad)) {}

BarReading BlurredBar::at(double along_m, double across_m) const {
  const Bar& bar = bar_;
  const double c = cos_roll_;
  const double s = sin_roll_;
  const double dz = along_m - bar.along_m;
  const double dy = across_m - bar.across_m;
  const double z = c * dz - s * dy;
  const double y = s * dz + c * dy;
  const Cover lengthwise = coverOf(z, bar.half_length_m, bar.blur_m);
  const Cover crosswise = coverOf(y, bar.half_width_m, bar.blur_m);
  BarReading reading;
  reading.cover = lengthwise.value * crosswise.value;
  reading.height_m = bar.offset_m + bar.height_m * reading.cover;
  if (reading.cover <= 0.0) {
    reading.derivative[4] = 1.0;
    return reading;
  }
  const double by_z = bar.height_m * lengthwise.by_x * crosswise.value;
  const double by_y = bar.height_m * lengthwise.value * crosswise.by_x;
  reading.derivative << -c * by_z - s * by_y, s * by_z - c * by_y, -y * by_z + z * by_y, reading.cover, 1.0,
      bar.height_m * lengthwise.by_half * crosswise.value, bar.height_m * lengthwise.value * crosswise.by_half,
      bar.height_m * (lengthwise.by_blur * crosswise.value + lengthwise.value * crosswise.by_blur);
  return reading;
}

}  // namespace oikos::registration
