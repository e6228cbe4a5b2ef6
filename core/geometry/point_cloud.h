// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace oikos::geometry {

using Rgb = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// Points with colours. The variable that holds one names the frame (`cloud_map`).
struct ColoredCloud {
  std::vector<Eigen::Vector3f> points;  ///< metres
  std::vector<Rgb> colors;              ///< one a point, or none at all
};

/// Triangles over shared vertices; counter-clockwise seen from outside (from free space).
struct ColoredMesh {
  ColoredCloud vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
};

}  // namespace oikos::geometry
