// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/floorplan/seen_rooms.h"

#include <cmath>

namespace oikos::mapping::test {

namespace {

Eigen::AlignedBox2d box(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

std::vector<Eigen::Vector2d> outlineOf(const Eigen::AlignedBox2d& room) {
  return {room.min(), Eigen::Vector2d(room.max().x(), room.min().y()), room.max(), Eigen::Vector2d(room.min().x(), room.max().y())};
}

}  // namespace

Rooms flat() {
  return {box(0.0, 0.0, 6.0, 1.6), box(0.0, 1.72, 3.4, 5.3), box(3.52, 1.72, 6.0, 4.0), box(1.0, -4.12, 6.0, -0.12)};
}

FloorPlan planOf(const Rooms& rooms) {
  FloorPlan plan;
  for (const Eigen::AlignedBox2d& room : rooms) {
    addRoom(outlineOf(room), plan);
  }
  return plan;
}

WallSketch seen(const Rooms& rooms, const Eigen::Isometry2d& T_plan_level) {
  const Eigen::Isometry2d T_level_plan = T_plan_level.inverse();
  WallSketch sketch;
  for (const PlanLine& line : planOf(rooms).lines) {
    const int count = static_cast<int>(std::lround(line.lengthM() / sketch.cell_m));
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d point_plan = line.from_plan + (i + 0.5) / count * (line.to_plan - line.from_plan);
      sketch.walls.push_back({T_level_plan * point_plan, T_level_plan.linear() * line.inwards});
    }
  }
  // Floor on the lattice of frame level, as a scan has it.
  constexpr int kReach = 250;
  for (int row = -kReach; row < kReach; ++row) {
    for (int column = -kReach; column < kReach; ++column) {
      const Eigen::Vector2d centre_level = sketch.cell_m * Eigen::Vector2d(column + 0.5, row + 0.5);
      const Eigen::Vector2d centre_plan = T_plan_level * centre_level;
      for (const Eigen::AlignedBox2d& room : rooms) {
        const Eigen::Vector2d from_walls = (centre_plan - room.min()).cwiseMin(room.max() - centre_plan);
        if (from_walls.minCoeff() > 0.1) {
          sketch.floor_level.push_back(centre_level);
        }
      }
    }
  }
  return sketch;
}

void openDoor(const Eigen::AlignedBox2d& doorway_plan, const Eigen::Isometry2d& T_plan_level, WallSketch& sketch) {
  std::erase_if(sketch.walls, [&](const WallPoint& wall) { return doorway_plan.contains(T_plan_level * wall.point_level); });
  constexpr int kReach = 250;
  for (int row = -kReach; row < kReach; ++row) {
    for (int column = -kReach; column < kReach; ++column) {
      const Eigen::Vector2d centre_level = sketch.cell_m * Eigen::Vector2d(column + 0.5, row + 0.5);
      if (doorway_plan.contains(T_plan_level * centre_level)) {
        sketch.floor_level.push_back(centre_level);
      }
    }
  }
}

Eigen::Isometry2d placed(double x_m, double y_m, double yaw_rad) {
  return Eigen::Translation2d(x_m, y_m) * Eigen::Rotation2Dd(yaw_rad);
}

PlacementError errorOf(const Eigen::Isometry2d& estimate, const Eigen::Isometry2d& truth) {
  return {(estimate.translation() - truth.translation()).norm(),
          std::abs(Eigen::Rotation2Dd(Eigen::Matrix2d(estimate.linear().transpose() * truth.linear())).smallestAngle())};
}

}  // namespace oikos::mapping::test
