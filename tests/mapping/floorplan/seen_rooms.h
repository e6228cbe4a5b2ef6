// SPDX-License-Identifier: Apache-2.0
// A home of rectangular rooms, and what a map shows of it: exact, on a lattice.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mapping/floorplan/floor_plan.h"
#include "mapping/floorplan/wall_scan.h"

namespace oikos::mapping::test {

using Rooms = std::vector<Eigen::AlignedBox2d>;

/// A hall of 6 m with two rooms on one side and one on the other, walls of 12 cm between: no symmetry.
[[nodiscard]] Rooms flat();

[[nodiscard]] FloorPlan planOf(const Rooms& rooms);

/// Every wall, and the floor up to 10 cm before it, seen from frame level.
[[nodiscard]] WallSketch seen(const Rooms& rooms, const Eigen::Isometry2d& T_plan_level);

/// Adds the floor of a doorway, and takes the walls within it away; frame plan.
void openDoor(const Eigen::AlignedBox2d& doorway_plan, const Eigen::Isometry2d& T_plan_level, WallSketch& sketch);

/// x, y (m), yaw (rad).
[[nodiscard]] Eigen::Isometry2d placed(double x_m, double y_m, double yaw_rad);

struct PlacementError {
  double distance_m;
  double turn_rad;
};
[[nodiscard]] PlacementError errorOf(const Eigen::Isometry2d& estimate, const Eigen::Isometry2d& truth);

}  // namespace oikos::mapping::test
