// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mapping/floorplan/floor_plan.h"

namespace oikos::mapping {

/// A line of the plan beside a point.
struct LineNearby {
  int line = -1;            ///< index into FloorPlan::lines
  double distance_m = 0.0;  ///< signed, along `normal_plan`
  Eigen::Vector2d normal_plan = Eigen::Vector2d::UnitX();
};

/// Finds the plan's line nearest to a point among those that may be what was seen there: nearly across the normal and, where the plan
/// knows the side, seen from the right one. Immutable, so thread-safe. `plan` must outlive it.
class LineGrid {
 public:
  /// `reach_m`: no line farther than this is ever asked for.
  LineGrid(const FloorPlan& plan, double reach_m);

  [[nodiscard]] std::optional<LineNearby> findNearest(const Eigen::Vector2d& point_plan, const Eigen::Vector2d& normal_plan,
                                                      double max_distance_m) const;

 private:
  [[nodiscard]] const std::vector<int>& linesAt(const Eigen::Vector2d& point_plan) const;

  struct Line {
    Eigen::Vector2d from;
    Eigen::Vector2d along;  ///< unit length
    double length_m;
    Eigen::Vector2d inwards;
  };
  std::vector<Line> lines_;
  double cell_m_;
  Eigen::Vector2d corner_plan_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::vector<int>> cells_;
  std::vector<int> none_;
};

/// Whether a ray meets any line of the plan that is a wall.
[[nodiscard]] bool meetsWall(const FloorPlan& plan, const Eigen::Vector2d& origin_plan, const Eigen::Vector2d& direction_plan);

}  // namespace oikos::mapping
