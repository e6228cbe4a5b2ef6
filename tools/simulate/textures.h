// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/base/enum_table.h"

namespace oikos::simulate {

/// What the surfaces of a home are made of. Each is a picture that repeats itself without a seam, computed from a seed.
enum class TextureKind { kWood, kPlanks, kTiles, kPlaster, kWallpaper, kFabric, kStone, kBrushedMetal, kPainting, kPrint };
constexpr auto enumTable(TextureKind) {
  return std::to_array<base::EnumName<TextureKind>>({{TextureKind::kWood, "wood"},
                                                     {TextureKind::kPlanks, "planks"},
                                                     {TextureKind::kTiles, "tiles"},
                                                     {TextureKind::kPlaster, "plaster"},
                                                     {TextureKind::kWallpaper, "wallpaper"},
                                                     {TextureKind::kFabric, "fabric"},
                                                     {TextureKind::kStone, "stone"},
                                                     {TextureKind::kBrushedMetal, "brushed_metal"},
                                                     {TextureKind::kPainting, "painting"},
                                                     {TextureKind::kPrint, "print"}});
}

/// CV_8UC3, `size_px` by `size_px`. All but paintings and prints are shades to be multiplied with a material's colour.
[[nodiscard]] cv::Mat makeTexture(TextureKind kind, std::uint64_t seed, int size_px);

}  // namespace oikos::simulate
