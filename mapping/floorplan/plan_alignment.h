// SPDX-License-Identifier: Apache-2.0
// Walls brought onto the lines of a plan: planar, point to line, by iteratively reweighted least squares (S58; Chen & Medioni 1992,
// doi:10.1016/0262-8856(92)90066-C; Geman & McClure's kernel), from coarse to fine.
#pragma once

#include <Eigen/Geometry>

#include "mapping/floorplan/line_grid.h"
#include "mapping/floorplan/wall_scan.h"

namespace oikos::mapping {

enum class PlanAlignmentStatus {
  kTooFewPairs,  ///< fewer than 20 walls lie near lines
  kDegenerate,   ///< the lines near walls leave a direction open: they run one way only
  kAligned,
};

struct [[nodiscard]] PlanAlignment {
  PlanAlignmentStatus status = PlanAlignmentStatus::kTooFewPairs;
  Eigen::Isometry2d T_plan_level = Eigen::Isometry2d::Identity();  ///< last accepted estimate
  int iterations = 0;
  int pairs = 0;                                        ///< in the last round
  double rms_m = 0.0;                                   ///< over those pairs, weighed
  Eigen::Vector2d open_plan = Eigen::Vector2d::Zero();  ///< the direction that is held worst, unit length
};

/// The farthest pair that is ever made.
constexpr double kPlanReach_m = 0.6;

/// `grid` is one of reach kPlanReach_m or more. `stride`: uses every n-th wall.
PlanAlignment alignToPlan(const WallSketch& sketch, const LineGrid& grid, const Eigen::Isometry2d& T_plan_level, int stride);

}  // namespace oikos::mapping
