// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace oikos::camera {

/// The sRGB curve (IEC 61966-2-1) between stored bytes and light, which is 1 at byte 255. All of a sensor's effects act on light.
class ToneCurve {
 public:
  static const ToneCurve& instance();

  [[nodiscard]] float toLight(std::uint8_t byte) const { return light_[byte]; }
  /// Light outside [0, 1] is cut off.
  [[nodiscard]] std::uint8_t toByte(float light) const {
    const float bounded = light < 1.0F ? (light > 0.0F ? light : 0.0F) : 1.0F;
    return byte_[static_cast<std::size_t>(bounded * static_cast<float>(kSteps) + 0.5F)];
  }

 private:
  ToneCurve();
  static constexpr int kSteps = 4095;  // fine enough that no byte is left out
  std::array<float, 256> light_{};
  std::array<std::uint8_t, kSteps + 1> byte_{};
};

}  // namespace oikos::camera
