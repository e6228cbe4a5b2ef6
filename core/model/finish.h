// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/model/triangle_mesh.h"

namespace oikos::model {

/// A material by its name, and its colour as 0xRRGGBB (sRGB).
struct Finish {
  std::string name;
  std::uint32_t rgb = 0xB0B0B0;
};

[[nodiscard]] inline Material makeMaterial(const Finish& finish) {
  const auto channel = [&](int shift) { return static_cast<float>((finish.rgb >> shift) & 0xFFU) / 255.0F; };
  return {.name = finish.name, .color_rgb = {channel(16), channel(8), channel(0)}, .texture = {}};
}

}  // namespace oikos::model
