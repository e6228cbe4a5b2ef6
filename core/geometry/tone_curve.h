// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace oikos::geometry {

/// The sRGB curve (IEC 61966-2-1) between what a screen or an image file is given and light; black is 0 and white 1 in both.
[[nodiscard]] float lightOfSrgb(float srgb);
[[nodiscard]] float srgbOfLight(float light);

/// The same between stored bytes and light, which is 1 at byte 255; from tables. Immutable, so thread-safe.
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
  static constexpr int kSteps = 16383;  // the darkest byte is five steps wide
  std::array<float, 256> light_{};
  std::array<std::uint8_t, kSteps + 1> byte_{};
};

}  // namespace oikos::geometry
