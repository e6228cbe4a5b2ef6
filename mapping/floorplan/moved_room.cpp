// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/moved_room.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

namespace oikos::mapping {

namespace {

constexpr double kCell_m = 0.05;
constexpr int kReach = 20;           ///< cells each way
constexpr double kLeast_m = 0.4;     ///< a shorter way may be furniture that stands along a wall
constexpr double kShortest_m = 3.0;  ///< less wall is no room
constexpr int kDirections = 8;

int directionOf(const Eigen::Vector2d& normal) {
  const double turn = (std::atan2(normal.y(), normal.x()) / (2.0 * std::numbers::pi) + 1.0) * kDirections;
  return static_cast<int>(std::lround(turn)) % kDirections;
}

std::uint8_t bit(int direction) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>((direction + kDirections) % kDirections));
}

/// Which way surfaces face in each cell or beside it: a bit a direction. Frame plan.
class SurfaceGrid {
 public:
  SurfaceGrid(const WallSketch& sketch, const Eigen::Isometry2d& T_plan_level) {
    Eigen::AlignedBox2d box;
    for (const WallPoint& wall : sketch.walls) {
      box.extend(T_plan_level * wall.point_level);
    }
    corner_ = box.min() - Eigen::Vector2d::Constant(2.0 * kCell_m);
    size_ = ((box.sizes().array() + 4.0 * kCell_m) / kCell_m).ceil().cast<int>() + 1;
    cells_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()), 0);
    for (const WallPoint& wall : sketch.walls) {
      const Eigen::Array2i cell = cellOf(T_plan_level * wall.point_level);
      const std::uint8_t faces = bit(directionOf(T_plan_level.linear() * wall.normal_level));
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          cells_[index(cell.x() + dx, cell.y() + dy)] |= faces;
        }
      }
    }
  }

  [[nodiscard]] Eigen::Array2i cellOf(const Eigen::Vector2d& point_plan) const {
    return ((point_plan - corner_) / kCell_m).array().floor().cast<int>();
  }
  [[nodiscard]] bool faces(const Eigen::Array2i& cell, std::uint8_t directions) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < size_.x() && cell.y() < size_.y() &&
           (cells_[index(cell.x(), cell.y())] & directions) != 0;
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.x()) + static_cast<std::size_t>(column);
  }

  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  Eigen::Array2i size_ = Eigen::Array2i::Zero();
  std::vector<std::uint8_t> cells_;
};

struct Sample {
  Eigen::Array2i cell;
  std::uint8_t directions;  ///< that a surface on it may face
};

void addSamples(const PlanLine& line, const SurfaceGrid& grid, std::vector<Sample>& samples) {
  const double length_m = line.lengthM();
  const Eigen::Vector2d along = (line.to_plan - line.from_plan).normalized();
  const Eigen::Vector2d normal = line.inwards.isZero() ? Eigen::Vector2d(-along.y(), along.x()) : line.inwards;
  const int direction = directionOf(normal);
  auto directions = static_cast<std::uint8_t>(bit(direction - 1) | bit(direction) | bit(direction + 1));
  if (line.inwards.isZero()) {
    const int behind = direction + kDirections / 2;
    directions = static_cast<std::uint8_t>(directions | bit(behind - 1) | bit(behind) | bit(behind + 1));
  }
  const int count = static_cast<int>(std::ceil(length_m / kCell_m));
  for (int i = 0; i < count; ++i) {
    samples.push_back({grid.cellOf(line.from_plan + (i + 0.5) / count * (line.to_plan - line.from_plan)), directions});
  }
}

int countSeen(const std::vector<Sample>& samples, const SurfaceGrid& grid, const Eigen::Array2i& shift) {
  return static_cast<int>(std::count_if(samples.begin(), samples.end(),
                                        [&](const Sample& sample) { return grid.faces(sample.cell + shift, sample.directions); }));
}

}  // namespace

MovedRoom findMovedRoom(const WallSketch& sketch, const FloorPlan& plan, const Eigen::Isometry2d& T_plan_level) {
  MovedRoom worst;
  if (sketch.walls.empty()) {
    return worst;
  }
  const SurfaceGrid grid(sketch, T_plan_level);
  std::map<int, std::vector<Sample>> rooms;
  for (const PlanLine& line : plan.lines) {
    if (line.is_wall) {
      addSamples(line, grid, rooms[line.room]);
    }
  }
  for (const auto& [room, samples] : rooms) {
    if (static_cast<double>(samples.size()) * kCell_m < kShortest_m) {
      continue;
    }
    const int here = countSeen(samples, grid, {0, 0});
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const Eigen::Vector2d shift = kCell_m * Eigen::Vector2d(dx, dy);
        const int gain = shift.norm() < kLeast_m ? 0 : countSeen(samples, grid, {dx, dy}) - here;
        if (gain * kCell_m > worst.gain_m) {
          worst = {room, shift, gain * kCell_m, static_cast<double>(gain) / static_cast<double>(samples.size())};
        }
      }
    }
  }
  return worst;
}

}  // namespace oikos::mapping
