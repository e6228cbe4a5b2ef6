// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "mapping/floorplan/plan_fit.h"

namespace oikos::mapping {

/// What a map's frame becomes.
enum class PlanFrame {
  kPlan,  ///< the plan's own
  kDock,  ///< along the plan's axes, its origin where the drive began: on the dock (S57)
};

/// A plan to lay a map onto.
struct PlanTask {
  FloorPlan plan;
  std::string source;  ///< the file's path, for messages
  PlanFrame frame = PlanFrame::kDock;
  std::optional<Eigen::Isometry2d> T_plan_base_expected = std::nullopt;  ///< where the drive probably began; decides between twins only
};

/// How a map was laid onto its plan.
struct PlanPlacement {
  std::string source;
  PlanFit fit;
  Eigen::Isometry2d T_plan_map = Eigen::Isometry2d::Identity();
  Eigen::Isometry2d T_map_base = Eigen::Isometry2d::Identity();  ///< the robot at the first frame
  FloorPlan plan;
};

/// Lays the walls of a drive onto a plan; the robot's first place is the origin of frame level, x ahead of it. Throws Error{kInput} with
/// the plan's name and the figure that says why, if it does not fit.
[[nodiscard]] PlanPlacement placeOnPlan(const WallSketch& sketch, const PlanTask& task, const PlanFitConfig& config);

}  // namespace oikos::mapping
