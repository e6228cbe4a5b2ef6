// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/tone_curve.h"

#include <cmath>
#include <cstddef>

namespace oikos::camera {

const ToneCurve& ToneCurve::instance() {
  static const ToneCurve kCurve;
  return kCurve;
}

ToneCurve::ToneCurve() {
  for (std::size_t i = 0; i < light_.size(); ++i) {
    const double value = static_cast<double>(i) / 255.0;
    light_[i] = static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  for (std::size_t i = 0; i < byte_.size(); ++i) {
    const double light = static_cast<double>(i) / kSteps;
    const double value = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    byte_[i] = static_cast<std::uint8_t>(std::lround(255.0 * value));
  }
}

}  // namespace oikos::camera
