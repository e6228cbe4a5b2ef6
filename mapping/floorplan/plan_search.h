// SPDX-License-Identifier: Apache-2.0
// Where on a plan a drive may have been, from nothing known: turns first, then offsets, each over their whole range.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "mapping/floorplan/floor_plan.h"
#include "mapping/floorplan/wall_scan.h"

namespace oikos::mapping {

struct PlanSearchConfig {
  double cell_m = 0.1;        ///< of the pictures that are laid over each other
  double blur_m = 0.15;       ///< a wall so far off its line is worth 0.6 of one on it
  double least_turn = 0.6;    ///< turns for which directions agree less than this share of the best are not tried
  int candidates_a_turn = 8;  ///< places kept for each turn
  int candidates = 16;        ///< and of all
  double apart_m = 0.3;       ///< places of one turn that are nearer than this are one

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("cell_m", cell_m);
    visitor("blur_m", blur_m);
    visitor("least_turn", least_turn);
    visitor("candidates_a_turn", candidates_a_turn);
    visitor("candidates", candidates);
    visitor("apart_m", apart_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct PlanCandidate {
  Eigen::Isometry2d T_plan_level = Eigen::Isometry2d::Identity();
  double score = 0.0;  ///< walls on lines, in cells
};

/// Best first; empty if there are no walls or no lines. Turns come from the directions of walls and lines, offsets from the correlation of
/// the walls with the plan's blurred lines, kept apart by direction, so that a wall counts on lines along it only.
[[nodiscard]] std::vector<PlanCandidate> searchPlan(const WallSketch& sketch, const FloorPlan& plan, const PlanSearchConfig& config);

}  // namespace oikos::mapping
