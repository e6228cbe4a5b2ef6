// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>

namespace oikos::mapping {

namespace {

constexpr double kStep_m = 0.05;         ///< along lines
constexpr double kBeside_m = 0.10;       ///< floor so far on both sides of a line is seen through it
constexpr double kBefore_m = 0.15;       ///< and so far before it shows that nothing hides it
constexpr double kStretch_m = 0.2;       ///< of wall
constexpr double kClearOfLine_m = 0.25;  ///< farther from a line than this a surface is not that line's
constexpr int kDirections = 16;
constexpr int kFewestWalls = 12;    ///< of the directions: a place from which fewer meet walls is in no room
constexpr double kCoarse_m = 0.25;  ///< cells for which the last is asked

using Cell = std::pair<int, int>;

Cell cellOf(const Eigen::Vector2d& point, double cell_m) {
  return {static_cast<int>(std::floor(point.x() / cell_m)), static_cast<int>(std::floor(point.y() / cell_m))};
}

double distanceToLine(const PlanLine& line, const Eigen::Vector2d& point_plan) {
  const Eigen::Vector2d edge = line.to_plan - line.from_plan;
  const double share = std::clamp(edge.dot(point_plan - line.from_plan) / std::max(edge.squaredNorm(), 1e-12), 0.0, 1.0);
  return (line.from_plan + share * edge - point_plan).norm();
}

class Weighing {
 public:
  Weighing(const WallSketch& sketch, const FloorPlan& plan, const LineGrid& grid, const Eigen::Isometry2d& T_plan_level,
           const EvidenceRules& rules)
      : sketch_(sketch), plan_(plan), grid_(grid), T_plan_level_(T_plan_level), T_level_plan_(T_plan_level.inverse()), rules_(rules) {
    for (const Eigen::Vector2d& centre : sketch.floor_level) {
      floor_.insert(cellOf(centre, sketch.cell_m));
    }
  }

  PlanFigures weigh() {
    supported_.resize(plan_.lines.size());
    for (std::size_t i = 0; i < plan_.lines.size(); ++i) {
      supported_[i].resize(static_cast<std::size_t>(std::ceil(plan_.lines[i].lengthM() / kStep_m)) + 1, 0);
    }
    weighSurface();
    weighLines();
    weighFloor();
    return figures_;
  }

 private:
  void weighSurface() {
    int on_plan = 0;
    int beyond = 0;
    double squares = 0.0;
    for (const WallPoint& wall : sketch_.walls) {
      const Eigen::Vector2d point_plan = T_plan_level_ * wall.point_level;
      const Eigen::Vector2d normal_plan = T_plan_level_.linear() * wall.normal_level;
      if (const auto line = grid_.findNearest(point_plan, normal_plan, rules_.on_line_m)) {
        ++on_plan;
        squares += line->distance_m * line->distance_m;
        support(line->line, point_plan);
      } else if (isBeyond(point_plan, normal_plan)) {
        ++beyond;
      }
    }
    const double all = std::max(1.0, static_cast<double>(sketch_.walls.size()));
    figures_.seen_m = sketch_.wallLengthM();
    figures_.on_plan_share = on_plan / all;
    figures_.beyond_share = beyond / all;
    figures_.rms_m = on_plan > 0 ? std::sqrt(squares / on_plan) : 0.0;
  }

  /// Furniture has a wall behind it; what has none, and is not the reveal or the frame of one, is a wall that the plan lacks.
  [[nodiscard]] bool isBeyond(const Eigen::Vector2d& point_plan, const Eigen::Vector2d& normal_plan) const {
    return !grid_.findNearest(point_plan, normal_plan, kClearOfLine_m) && !meetsWall(plan_, point_plan, -normal_plan);
  }

  void support(int number, const Eigen::Vector2d& point_plan) {
    const PlanLine& line = plan_.lines[static_cast<std::size_t>(number)];
    const Eigen::Vector2d along = (line.to_plan - line.from_plan).normalized();
    std::vector<char>& samples = supported_[static_cast<std::size_t>(number)];
    const int middle = static_cast<int>(std::lround(along.dot(point_plan - line.from_plan) / kStep_m));
    for (int i = std::max(0, middle - 1); i <= std::min(static_cast<int>(samples.size()) - 1, middle + 1); ++i) {
      samples[static_cast<std::size_t>(i)] = 1;
    }
  }

  void weighLines() {
    for (std::size_t i = 0; i < plan_.lines.size(); ++i) {
      if (plan_.lines[i].is_wall) {
        weighLine(plan_.lines[i], supported_[i]);
      }
    }
    figures_.supported_share = figures_.plan_m > 0.0 ? figures_.supported_m / figures_.plan_m : 0.0;
  }

  /// What runs on without a wall: where that is more than a doorway, it speaks against the plan. Furniture before a line, which hides both
  /// floor and wall, does not end a run; a stretch of wall that was seen does.
  class Run {
   public:
    explicit Run(double doorway_m) : doorway_m_(doorway_m) {}
    void lengthen(double step_m) { run_m_ += step_m; }
    void end() {
      excess_m_ += std::max(0.0, run_m_ - doorway_m_);
      run_m_ = 0.0;
    }
    [[nodiscard]] double excessM() const { return excess_m_ + std::max(0.0, run_m_ - doorway_m_); }

   private:
    double doorway_m_;
    double run_m_ = 0.0;
    double excess_m_ = 0.0;
  };

  void weighLine(const PlanLine& line, const std::vector<char>& supported) {
    const double length_m = line.lengthM();
    const double step_m = length_m / static_cast<double>(supported.size());
    Run crossed(rules_.doorway_m);
    Run missing(rules_.doorway_m);
    double wall_m = 0.0;
    for (std::size_t i = 0; i < supported.size(); ++i) {
      if (supported[i] != 0) {
        figures_.supported_m += step_m;
        wall_m += step_m;
        if (wall_m >= kStretch_m) {
          crossed.end();
          missing.end();
        }
        continue;
      }
      wall_m = 0.0;
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(supported.size());
      const Surroundings floor = floorBeside(line, share);
      if (floor.on_line && floor.inside && floor.outside) {
        crossed.lengthen(step_m);
      }
      if (floor.before) {
        missing.lengthen(step_m);
      }
    }
    figures_.plan_m += length_m;
    figures_.crossed_m += crossed.excessM();
    figures_.missing_m += missing.excessM();
  }

  /// Where floor was seen about a place on a line.
  struct Surroundings {
    bool on_line = false;
    bool inside = false;
    bool outside = false;
    bool before = false;  ///< on the room's side; on both if the plan does not know it: behind a wall there is another room's floor
  };
  [[nodiscard]] Surroundings floorBeside(const PlanLine& line, double share) const {
    const Eigen::Vector2d along = (line.to_plan - line.from_plan).normalized();
    const Eigen::Vector2d inwards = line.inwards.isZero() ? Eigen::Vector2d(-along.y(), along.x()) : line.inwards;
    const Eigen::Vector2d place_plan = line.from_plan + share * (line.to_plan - line.from_plan);
    const auto isSeen = [&](double from_line_m) { return isFloor(place_plan + from_line_m * inwards); };
    Surroundings floor{isSeen(0.0), isSeen(kBeside_m), isSeen(-kBeside_m), false};
    floor.before = isSeen(kBefore_m) && isSeen(kBefore_m + kBeside_m);
    if (line.inwards.isZero()) {
      floor.before = floor.before && (isSeen(-kBefore_m) && isSeen(-kBefore_m - kBeside_m));
    }
    return floor;
  }

  [[nodiscard]] bool isFloor(const Eigen::Vector2d& place_plan) const {
    return floor_.contains(cellOf(T_level_plan_ * place_plan, sketch_.cell_m));
  }

  void weighFloor() {
    std::set<Cell> coarse;
    for (const Eigen::Vector2d& centre : sketch_.floor_level) {
      coarse.insert(cellOf(centre, kCoarse_m));
    }
    int outside = 0;
    for (const Cell& cell : coarse) {
      const Eigen::Vector2d centre_level = kCoarse_m * Eigen::Vector2d(cell.first + 0.5, cell.second + 0.5);
      outside += isOutside(T_plan_level_ * centre_level) ? 1 : 0;
    }
    figures_.floor_outside_m2 = outside * kCoarse_m * kCoarse_m;
    figures_.floor_outside_share = coarse.empty() ? 0.0 : outside / static_cast<double>(coarse.size());
  }

  /// And not just beyond a line: floor is seen that far into an open door's way.
  [[nodiscard]] bool isOutside(const Eigen::Vector2d& place_plan) const {
    return !isInRoom(place_plan) && std::none_of(plan_.lines.begin(), plan_.lines.end(),
                                                 [&](const PlanLine& line) { return distanceToLine(line, place_plan) < kClearOfLine_m; });
  }

  /// Drawings have gaps for doors: most directions must meet walls, not all.
  [[nodiscard]] bool isInRoom(const Eigen::Vector2d& place_plan) const {
    int walls = 0;
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = (i + 0.5) * 2.0 * std::numbers::pi / kDirections;
      walls += meetsWall(plan_, place_plan, {std::cos(angle_rad), std::sin(angle_rad)}) ? 1 : 0;
    }
    return walls >= kFewestWalls;
  }

  const WallSketch& sketch_;
  const FloorPlan& plan_;
  const LineGrid& grid_;
  Eigen::Isometry2d T_plan_level_;
  Eigen::Isometry2d T_level_plan_;
  EvidenceRules rules_;
  std::set<Cell> floor_;
  std::vector<std::vector<char>> supported_;
  PlanFigures figures_;
};

}  // namespace

PlanFigures weighPlan(const WallSketch& sketch, const FloorPlan& plan, const LineGrid& grid, const Eigen::Isometry2d& T_plan_level,
                      const EvidenceRules& rules) {
  return Weighing(sketch, plan, grid, T_plan_level, rules).weigh();
}

}  // namespace oikos::mapping
