// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/tone_curve.h"

#include <gtest/gtest.h>

namespace oikos::geometry {
namespace {

TEST(ToneCurve, EveryByteComesBack) {
  const ToneCurve& curve = ToneCurve::instance();
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(curve.toByte(curve.toLight(static_cast<std::uint8_t>(byte))), byte);
  }
  EXPECT_EQ(curve.toByte(-0.1F), 0);
  EXPECT_EQ(curve.toByte(7.0F), 255);
}

TEST(ToneCurve, IsTheOneOfTheStandard) {
  EXPECT_NEAR(lightOfSrgb(0.5F), 0.21404F, 1e-5F);
  EXPECT_NEAR(lightOfSrgb(0.02F), 0.02F / 12.92F, 1e-7F);
  EXPECT_EQ(ToneCurve::instance().toByte(0.2122F), 127);  // half of the code is a fifth of the light
  for (int i = 0; i <= 100; ++i) {
    const float srgb = 0.01F * static_cast<float>(i);
    EXPECT_NEAR(srgbOfLight(lightOfSrgb(srgb)), srgb, 2e-6F);
  }
}

}  // namespace
}  // namespace oikos::geometry
