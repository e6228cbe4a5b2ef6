// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_task.h"

#include "core/base/error.h"

namespace oikos::mapping {

PlanPlacement placeOnPlan(const WallSketch& sketch, const PlanTask& task, const PlanFitConfig& config) {
  PlanPlacement placement{task.source, fitToPlan(sketch, task.plan, config, task.T_plan_base_expected), {}, {}, task.plan};
  if (placement.fit.status != PlanFitStatus::kFitted) {
    throw base::Error(base::ErrorCode::kInput, "the map does not fit: " + placement.fit.reason, task.source);
  }
  const Eigen::Isometry2d& T_plan_base = placement.fit.T_plan_level;
  placement.T_plan_map.setIdentity();
  if (task.frame == PlanFrame::kDock) {
    placement.T_plan_map.translation() = T_plan_base.translation();
  }
  placement.T_map_base = placement.T_plan_map.inverse() * T_plan_base;
  return placement;
}

}  // namespace oikos::mapping
