// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_alignment.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

namespace oikos::mapping {

namespace {

constexpr int kFewestPairs = 20;
constexpr int kMaxIterations = 20;  ///< a stage
constexpr double kSettled_m = 2e-5;
constexpr double kSettled_rad = 1e-5;
constexpr double kOpenShare = 0.01;  ///< of the weight: less across a direction leaves it open

struct Stage {
  double reach_m;
  double kernel_m;  ///< a pair so far apart has a quarter of the weight
};
constexpr std::array<Stage, 3> kStages = {{{kPlanReach_m, 0.25}, {0.3, 0.08}, {0.12, 0.03}}};

/// r = n . (T p - q) over the pairs, for a step (x, y, yaw) at the right of T, yaw about the walls' middle.
struct Equations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  Eigen::Matrix2d normals = Eigen::Matrix2d::Zero();  ///< weighed sum of n n^T, plan
  double weight = 0.0;
  double squares = 0.0;
  int pairs = 0;
};

class Aligner {
 public:
  Aligner(const WallSketch& sketch, const LineGrid& grid, int stride) : sketch_(sketch), grid_(grid), stride_(stride) {
    for (const WallPoint& wall : sketch.walls) {
      middle_level_ += wall.point_level / static_cast<double>(sketch.walls.size());
    }
  }

  PlanAlignment run(const Eigen::Isometry2d& T_plan_level) {
    PlanAlignment result;
    result.T_plan_level = T_plan_level;
    for (const Stage& stage : kStages) {
      for (int i = 0; i < kMaxIterations; ++i) {
        const Equations equations = gather(result.T_plan_level, stage);
        note(equations, result);
        if (result.status != PlanAlignmentStatus::kAligned) {
          return result;
        }
        const Eigen::Vector3d step = -equations.H.ldlt().solve(equations.g);
        result.T_plan_level = moved(result.T_plan_level, step);
        ++result.iterations;
        if (step.head<2>().norm() < kSettled_m && std::abs(step.z()) < kSettled_rad) {
          break;
        }
      }
    }
    note(gather(result.T_plan_level, kStages.back()), result);
    return result;
  }

 private:
  [[nodiscard]] Equations gather(const Eigen::Isometry2d& T, const Stage& stage) const {
    Equations equations;
    const Eigen::Matrix2d R = T.linear();
    const double scale_sq = stage.kernel_m * stage.kernel_m;
    for (std::size_t i = 0; i < sketch_.walls.size(); i += static_cast<std::size_t>(stride_)) {
      const WallPoint& wall = sketch_.walls[i];
      const auto line = grid_.findNearest(T * wall.point_level, R * wall.normal_level, stage.reach_m);
      if (!line) {
        continue;
      }
      const Eigen::Vector2d arm = wall.point_level - middle_level_;
      const Eigen::RowVector2d n = line->normal_plan.transpose() * R;
      const Eigen::Vector3d J(n.x(), n.y(), n.dot(Eigen::Vector2d(-arm.y(), arm.x())));
      const double r = line->distance_m;
      const double share = scale_sq / (scale_sq + r * r);
      const double w = share * share;
      equations.H += w * J * J.transpose();
      equations.g += w * r * J;
      equations.normals += w * line->normal_plan * line->normal_plan.transpose();
      equations.weight += w;
      equations.squares += w * r * r;
      ++equations.pairs;
    }
    return equations;
  }

  static void note(const Equations& equations, PlanAlignment& result) {
    result.pairs = equations.pairs;
    result.rms_m = equations.weight > 0.0 ? std::sqrt(equations.squares / equations.weight) : 0.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> directions(equations.normals);
    result.open_plan = directions.eigenvectors().col(0);
    const bool open = directions.eigenvalues()(0) < kOpenShare * equations.weight;
    result.status = equations.pairs < kFewestPairs ? PlanAlignmentStatus::kTooFewPairs
                    : open                         ? PlanAlignmentStatus::kDegenerate
                                                   : PlanAlignmentStatus::kAligned;
  }

  [[nodiscard]] Eigen::Isometry2d moved(const Eigen::Isometry2d& T, const Eigen::Vector3d& step) const {
    const Eigen::Isometry2d motion =
        Eigen::Translation2d(middle_level_ + step.head<2>()) * Eigen::Rotation2Dd(step.z()) * Eigen::Translation2d(-middle_level_);
    return T * motion;
  }

  const WallSketch& sketch_;
  const LineGrid& grid_;
  int stride_;
  Eigen::Vector2d middle_level_ = Eigen::Vector2d::Zero();
};

}  // namespace

PlanAlignment alignToPlan(const WallSketch& sketch, const LineGrid& grid, const Eigen::Isometry2d& T_plan_level, int stride) {
  return Aligner(sketch, grid, stride).run(T_plan_level);
}

}  // namespace oikos::mapping
