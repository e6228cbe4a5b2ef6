// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::simulate {

/// A hole in a wall, from the floor upwards: a door's.
struct WallOpening {
  Eigen::Vector2d from_map;  ///< its two sides, on the wall or up to its thickness beside it
  Eigen::Vector2d to_map;
  double height_m = 2.0;
};

struct RoomShell {
  std::vector<Eigen::Vector2d> outline_map;  ///< either way round, not crossing itself
  std::vector<WallOpening> openings;
  double height_m = 2.5;
  double skirting_m = 0.07;
};

/// Materials of a shell's mesh.
enum ShellMaterial : std::uint32_t { kFloorMaterial, kCeilingMaterial, kWallMaterial, kSkirtingMaterial, kShellMaterialCount };

/// After so many metres a shell's texture repeats itself. Nothing within a room does: its walls lie side by side in the texture, one row
/// above the other, or one wall could be taken for another.
constexpr double kShellTexture_m = 8.0;

/// The floor within a doorway, between the floors of two rooms.
[[nodiscard]] model::TriangleMesh makeThreshold(const WallOpening& opening);

/// Floor, ceiling, walls and skirting of a room as they are seen from inside; texture coordinates are metres.
[[nodiscard]] model::TriangleMesh makeShell(const RoomShell& shell);

}  // namespace oikos::simulate
