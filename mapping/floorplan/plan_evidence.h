// SPDX-License-Identifier: Apache-2.0
// What speaks for and against a map that is laid onto a plan.
#pragma once

#include <Eigen/Geometry>

#include "mapping/floorplan/line_grid.h"
#include "mapping/floorplan/wall_scan.h"

namespace oikos::mapping {

/// Lengths are of lines and walls as seen from above.
struct PlanFigures {
  double plan_m = 0.0;           ///< walls that the plan has
  double seen_m = 0.0;           ///< upright surface that the map has, furniture with it; at most: see WallSketch
  double on_plan_share = 0.0;    ///< of that surface: on a line of the plan
  double supported_m = 0.0;      ///< of the plan's walls: seen where they are drawn
  double supported_share = 0.0;  ///< of the plan's walls
  double crossed_m = 0.0;        ///< of the plan's walls: floor was seen on both sides and on the line, more than a doorway's width at once
  double missing_m = 0.0;  ///< of the plan's walls: floor was seen right before them, but no wall; more than a doorway's width at once
  double floor_outside_m2 = 0.0;     ///< floor that was seen where the plan has no room
  double floor_outside_share = 0.0;  ///< of the floor that was seen
  double beyond_share = 0.0;  ///< of the surface that was seen: neither on a line nor before one, so beyond the plan's outermost walls
  double rms_m = 0.0;         ///< of the surface on lines, from them
};

struct EvidenceRules {
  double on_line_m = 0.08;  ///< a surface that is nearer to a line is on it
  double doorway_m = 1.2;   ///< so much of a line may lead over floor in one piece
};

[[nodiscard]] PlanFigures weighPlan(const WallSketch& sketch, const FloorPlan& plan, const LineGrid& grid,
                                    const Eigen::Isometry2d& T_plan_level, const EvidenceRules& rules);

}  // namespace oikos::mapping
