// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/tone_curve.h"

#include <cmath>

namespace oikos::geometry {

float lightOfSrgb(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

float srgbOfLight(float light) {
  return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
}

const ToneCurve& ToneCurve::instance() {
  static const ToneCurve kCurve;
  return kCurve;
}

ToneCurve::ToneCurve() {
  for (std::size_t i = 0; i < light_.size(); ++i) {
    light_[i] = lightOfSrgb(static_cast<float>(i) / 255.0F);
  }
  for (std::size_t i = 0; i < byte_.size(); ++i) {
    byte_[i] = static_cast<std::uint8_t>(std::lround(255.0F * srgbOfLight(static_cast<float>(i) / kSteps)));
  }
}

}  // namespace oikos::geometry
