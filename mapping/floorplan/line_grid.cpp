// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/line_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace oikos::mapping {

namespace {

constexpr double kMaxTurnCosine = 0.906;  ///< 25° between a surface and the line that it may be
constexpr double kBeyondEnd_m = 0.06;     ///< a line may be so much longer than drawn

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::AlignedBox2d boxOf(const FloorPlan& plan) {
  Eigen::AlignedBox2d box;
  for (const PlanLine& line : plan.lines) {
    box.extend(line.from_plan);
    box.extend(line.to_plan);
  }
  return box;
}

}  // namespace

LineGrid::LineGrid(const FloorPlan& plan, double reach_m) : cell_m_(0.5) {
  Eigen::AlignedBox2d box = boxOf(plan);
  if (box.isEmpty()) {
    return;
  }
  const double margin_m = reach_m + kBeyondEnd_m;
  cell_m_ = std::max(cell_m_, box.sizes().maxCoeff() / 1000.0);
  corner_plan_ = box.min() - Eigen::Vector2d::Constant(margin_m);
  const Eigen::Vector2d size_m = box.sizes() + Eigen::Vector2d::Constant(2.0 * margin_m);
  columns_ = static_cast<int>(size_m.x() / cell_m_) + 1;
  rows_ = static_cast<int>(size_m.y() / cell_m_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (const PlanLine& line : plan.lines) {
    const double length_m = std::max(line.lengthM(), 1e-9);
    const Line entry{line.from_plan, (line.to_plan - line.from_plan) / length_m, length_m, line.inwards};
    const int number = static_cast<int>(lines_.size());
    lines_.push_back(entry);
    const Eigen::Vector2d low = (line.from_plan.cwiseMin(line.to_plan) - corner_plan_).array() - margin_m;
    const Eigen::Vector2d high = (line.from_plan.cwiseMax(line.to_plan) - corner_plan_).array() + margin_m;
    const auto column = [&](double x) { return std::clamp(static_cast<int>(x / cell_m_), 0, columns_ - 1); };
    const auto row = [&](double y) { return std::clamp(static_cast<int>(y / cell_m_), 0, rows_ - 1); };
    for (int r = row(low.y()); r <= row(high.y()); ++r) {
      for (int c = column(low.x()); c <= column(high.x()); ++c) {
        const Eigen::Vector2d centre = corner_plan_ + cell_m_ * Eigen::Vector2d(c + 0.5, r + 0.5);
        if (std::abs(cross(entry.along, centre - entry.from)) < margin_m + cell_m_) {
          cells_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)].push_back(number);
        }
      }
    }
  }
}

const std::vector<int>& LineGrid::linesAt(const Eigen::Vector2d& point_plan) const {
  const Eigen::Vector2d place = (point_plan - corner_plan_) / cell_m_;
  if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < columns_ && place.y() < rows_)) {
    return none_;
  }
  return cells_[static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(place.x())];
}

std::optional<LineNearby> LineGrid::findNearest(const Eigen::Vector2d& point_plan, const Eigen::Vector2d& normal_plan,
                                                double max_distance_m) const {
  std::optional<LineNearby> nearest;
  double least_m = max_distance_m;
  for (const int number : linesAt(point_plan)) {
    const Line& line = lines_[static_cast<std::size_t>(number)];
    const Eigen::Vector2d offset = point_plan - line.from;
    const double along_m = line.along.dot(offset);
    if (along_m < -kBeyondEnd_m || along_m > line.length_m + kBeyondEnd_m) {
      continue;
    }
    const Eigen::Vector2d normal(-line.along.y(), line.along.x());
    const double distance_m = normal.dot(offset);
    const bool faces =
        line.inwards.isZero() ? std::abs(normal.dot(normal_plan)) > kMaxTurnCosine : line.inwards.dot(normal_plan) > kMaxTurnCosine;
    if (faces && std::abs(distance_m) < least_m) {
      least_m = std::abs(distance_m);
      nearest = LineNearby{number, distance_m, normal};
    }
  }
  return nearest;
}

bool meetsWall(const FloorPlan& plan, const Eigen::Vector2d& origin_plan, const Eigen::Vector2d& direction_plan) {
  return std::any_of(plan.lines.begin(), plan.lines.end(), [&](const PlanLine& line) {
    const Eigen::Vector2d a = line.from_plan - origin_plan;
    const Eigen::Vector2d edge = line.to_plan - line.from_plan;
    const double turn = cross(direction_plan, edge);
    if (!line.is_wall || std::abs(turn) < 1e-12) {
      return false;
    }
    const double along = cross(a, edge) / turn;
    const double share = cross(a, direction_plan) / turn;
    return along >= 0.0 && share >= 0.0 && share <= 1.0;
  });
}

}  // namespace oikos::mapping
