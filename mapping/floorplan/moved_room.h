// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "mapping/floorplan/floor_plan.h"
#include "mapping/floorplan/wall_scan.h"

namespace oikos::mapping {

/// A room of the plan that the map has elsewhere.
struct MovedRoom {
  int room = -1;                                         ///< PlanLine::room; -1: none
  Eigen::Vector2d shift_plan = Eigen::Vector2d::Zero();  ///< from where it is drawn to where it was seen
  double gain_m = 0.0;                                   ///< so much more of its walls is seen there than here
  double gain_share = 0.0;                               ///< of its walls
};

/// Slides each room of the plan by up to a metre each way over the walls that were seen, and tells of the one that gains most by it, if it
/// slides by 0.4 m or more. A room that is drawn where it is gains nothing.
[[nodiscard]] MovedRoom findMovedRoom(const WallSketch& sketch, const FloorPlan& plan, const Eigen::Isometry2d& T_plan_level);

}  // namespace oikos::mapping
