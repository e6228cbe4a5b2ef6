// SPDX-License-Identifier: Apache-2.0
// How `keyframes.sqlite` keeps what is in it; its writer and its reader include this.
#pragma once

#include <bit>
#include <cstdint>

namespace oikos::mapping {

static_assert(std::endian::native == std::endian::little);

inline constexpr const char* kFormat = "oikos-keyframes";
inline constexpr int kVersion = 1;
inline constexpr double kDepthUnitsPerMetre = 5000.0;

/// One feature in the blob.
struct FeatureRow {
  double pixel[2];
  double point_camera[3];
  std::uint64_t descriptor[4];
};

struct LandmarkRow {
  double pixel[2];
  double inverse_depth;
  double sigma;
  double inverse_depth_gradient[2];
};

}  // namespace oikos::mapping
