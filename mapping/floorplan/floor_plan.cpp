// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/floor_plan.h"

namespace oikos::mapping {

namespace {

constexpr double kShortest_m = 0.001;

double doubleArea(const std::vector<Eigen::Vector2d>& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area;
}

/// `side`: 1 for lines that are seen from the left of a counter-clockwise outline, which is inside; -1 from outside.
void addSides(const std::vector<Eigen::Vector2d>& outline, double side, bool is_wall, FloorPlan& plan) {
  const double turn = doubleArea(outline) < 0.0 ? -side : side;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    const double length_m = (b - a).norm();
    if (length_m >= kShortest_m) {
      const Eigen::Vector2d along = (b - a) / length_m;
      plan.lines.push_back({a, b, turn * Eigen::Vector2d(-along.y(), along.x()), is_wall});
    }
  }
}

}  // namespace

void addRoom(const std::vector<Eigen::Vector2d>& outline_plan, FloorPlan& plan) {
  addSides(outline_plan, 1.0, true, plan);
}

void addFixture(const std::vector<Eigen::Vector2d>& outline_plan, FloorPlan& plan) {
  addSides(outline_plan, -1.0, false, plan);
}

}  // namespace oikos::mapping
