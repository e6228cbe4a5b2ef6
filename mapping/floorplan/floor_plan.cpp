// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/floor_plan.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include "core/geometry/outline_area.h"

namespace oikos::mapping {

namespace {

constexpr double kShortest_m = 0.001;
constexpr double kTouching_m = 0.01;

/// `side`: 1 for lines that are seen from the left of a counter-clockwise outline, which is inside; -1 from outside.
void addSides(const std::vector<Eigen::Vector2d>& outline, double side, bool is_wall, FloorPlan& plan) {
  const double turn = geometry::signedDoubleArea(outline) < 0.0 ? -side : side;
  const int room = plan.lines.empty() ? 0 : plan.lines.back().room + 1;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    const double length_m = (b - a).norm();
    if (length_m >= kShortest_m) {
      const Eigen::Vector2d along = (b - a) / length_m;
      plan.lines.push_back({a, b, turn * Eigen::Vector2d(-along.y(), along.x()), is_wall, room});
    }
  }
}

}  // namespace

void numberRooms(FloorPlan& plan) {
  // Ends that lie in one cell of a centimetre, or in neighbouring ones, touch.
  std::map<std::pair<std::int64_t, std::int64_t>, int> room_at;
  std::vector<int> joined;  // room -> the one that it turned out to be part of
  const auto rootOf = [&](int room) {
    while (joined[static_cast<std::size_t>(room)] != room) {
      room = joined[static_cast<std::size_t>(room)];
    }
    return room;
  };
  for (PlanLine& line : plan.lines) {
    line.room = static_cast<int>(joined.size());
    joined.push_back(line.room);
    for (const Eigen::Vector2d& end : {line.from_plan, line.to_plan}) {
      const auto column = static_cast<std::int64_t>(std::floor(end.x() / kTouching_m));
      const auto row = static_cast<std::int64_t>(std::floor(end.y() / kTouching_m));
      for (std::int64_t i = 0; i < 9; ++i) {
        const auto other = room_at.find({column + i % 3 - 1, row + i / 3 - 1});
        if (other != room_at.end()) {
          joined[static_cast<std::size_t>(rootOf(line.room))] = rootOf(other->second);
        }
      }
      room_at[{column, row}] = line.room;
    }
  }
  for (PlanLine& line : plan.lines) {
    line.room = rootOf(line.room);
  }
}

void addRoom(const std::vector<Eigen::Vector2d>& outline_plan, FloorPlan& plan) {
  addSides(outline_plan, 1.0, true, plan);
}

void addFixture(const std::vector<Eigen::Vector2d>& outline_plan, FloorPlan& plan) {
  addSides(outline_plan, -1.0, false, plan);
}

}  // namespace oikos::mapping
