// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/relative_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/camera/depth_noise.h"
#include "core/geometry/rigid_alignment.h"

namespace oikos::mapping {

namespace {

class Gate {
 public:
  Gate(const camera::PinholeCamera& camera, const RelativeMotionConfig& config)
      : camera_(camera), limit_px_(config.inlier_px * camera.width / 640.0), depth_sigmas_(config.inlier_depth_sigmas) {}

  [[nodiscard]] bool agrees(const Eigen::Isometry3d& T_a_b, const Eigen::Vector3d& point_b, const Eigen::Vector3d& point_a,
                            const Eigen::Vector2d& pixel_a) const {
    const Eigen::Vector3d p = T_a_b * point_b;
    if (p.z() < 0.05 || (camera_.project(p) - pixel_a).squaredNorm() > limit_px_ * limit_px_) {
      return false;
    }
    const double sigma_m = std::hypot(camera::depthSigma_m(point_a.z()), camera::depthSigma_m(point_b.z()));
    return std::abs(p.z() - point_a.z()) < depth_sigmas_ * sigma_m + 0.01;
  }

 private:
  const camera::PinholeCamera& camera_;
  double limit_px_;
  double depth_sigmas_;
};

struct Problem {
  const Features& a;
  const Features& b;
  const std::vector<FeatureMatch>& matches;
  Gate gate;

  [[nodiscard]] std::vector<int> inliers(const Eigen::Isometry3d& T_a_b) const {
    std::vector<int> found;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      const auto i = static_cast<std::size_t>(matches[k].a);
      const auto j = static_cast<std::size_t>(matches[k].b);
      if (gate.agrees(T_a_b, b.point_camera[j], a.point_camera[i], a.pixel[i])) {
        found.push_back(static_cast<int>(k));
      }
    }
    return found;
  }

  [[nodiscard]] geometry::RigidAlignment align(const std::vector<int>& chosen) const {
    std::vector<Eigen::Vector3d> points_a;
    std::vector<Eigen::Vector3d> points_b;
    for (const int k : chosen) {
      points_a.push_back(a.point_camera[static_cast<std::size_t>(matches[static_cast<std::size_t>(k)].a)]);
      points_b.push_back(b.point_camera[static_cast<std::size_t>(matches[static_cast<std::size_t>(k)].b)]);
    }
    return geometry::alignRigid(points_a, points_b);
  }
};

/// Three different matches; the modulo's bias is far below what matters here, and it is the same on every platform.
std::vector<int> drawThree(std::mt19937_64& random, int count) {
  std::vector<int> drawn;
  while (drawn.size() < 3) {
    const int k = static_cast<int>(random() % static_cast<std::uint64_t>(count));
    if (std::find(drawn.begin(), drawn.end(), k) == drawn.end()) {
      drawn.push_back(k);
    }
  }
  return drawn;
}

/// Hypotheses that are enough to draw three inliers once with 99.9 % probability.
int hypothesesNeeded(std::size_t inliers, std::size_t matches, int most) {
  const double ratio = static_cast<double>(inliers) / static_cast<double>(matches);
  const double miss = 1.0 - ratio * ratio * ratio;
  return miss <= 1e-9 ? 1 : std::min(most, static_cast<int>(std::ceil(std::log(1e-3) / std::log(miss))));
}

std::vector<int> bestConsensus(const Problem& problem, const RelativeMotionConfig& config, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<int> best;
  int needed = config.max_hypotheses;
  for (int h = 0; h < needed; ++h) {
    const geometry::RigidAlignment sample = problem.align(drawThree(random, static_cast<int>(problem.matches.size())));
    if (sample.status != geometry::RigidAlignmentStatus::kAligned || sample.rms_m > 0.15) {
      continue;
    }
    std::vector<int> inliers = problem.inliers(sample.T_a_b);
    if (inliers.size() > best.size()) {
      best = std::move(inliers);
      needed = hypothesesNeeded(best.size(), problem.matches.size(), config.max_hypotheses);
    }
  }
  return best;
}

double spreadOf(const std::vector<int>& inliers, const Problem& problem, const camera::PinholeCamera& camera) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const int k : inliers) {
    const Eigen::Vector2d& px = problem.a.pixel[static_cast<std::size_t>(problem.matches[static_cast<std::size_t>(k)].a)];
    mean += px;
    square += px * px.transpose();
  }
  const auto n = static_cast<double>(inliers.size());
  mean /= n;
  const Eigen::Matrix2d covariance = square / n - mean * mean.transpose();
  constexpr double kPi = 3.14159265358979;
  return 4.0 * kPi * std::sqrt(std::max(0.0, covariance.determinant())) / (camera.width * camera.height);
}

PoseSolution refine(const std::vector<int>& inliers, const Problem& problem, const camera::PinholeCamera& camera,
                    const Eigen::Isometry3d& T_b_a) {
  std::vector<PointSighting> sightings;
  for (const int k : inliers) {
    const auto i = static_cast<std::size_t>(problem.matches[static_cast<std::size_t>(k)].a);
    const auto j = static_cast<std::size_t>(problem.matches[static_cast<std::size_t>(k)].b);
    const double pixel_sigma_px = 1.0 * camera.width / 640.0;
    sightings.push_back({problem.b.point_camera[j], problem.a.pixel[i], problem.a.point_camera[i].z(), pixel_sigma_px});
  }
  PoseSolverConfig config;
  config.depth_weight = 1.0;
  return solvePose(sightings, camera, T_b_a, config);
}

}  // namespace

RelativeMotion estimateMotion(const Features& a, const Features& b, const std::vector<FeatureMatch>& matches,
                              const camera::PinholeCamera& camera, const RelativeMotionConfig& config, std::uint64_t seed) {
  RelativeMotion motion;
  if (static_cast<int>(matches.size()) < std::max(3, config.min_inliers)) {
    return motion;
  }
  const Problem problem{a, b, matches, Gate(camera, config)};
  motion.status = MotionStatus::kTooFewInliers;
  motion.inlier = bestConsensus(problem, config, seed);
  if (static_cast<int>(motion.inlier.size()) < config.min_inliers) {
    return motion;
  }
  const geometry::RigidAlignment aligned = problem.align(motion.inlier);
  if (aligned.status != geometry::RigidAlignmentStatus::kAligned) {
    return motion;
  }
  // "World" of the solver is b, its camera a: the solution is T_b_a.
  const PoseSolution refined = refine(motion.inlier, problem, camera, aligned.T_a_b.inverse());
  if (refined.status != PoseStatus::kConverged) {
    return motion;
  }
  motion.T_a_b = refined.T_world_camera.inverse();
  motion.inlier = problem.inliers(motion.T_a_b);
  motion.rms_px = refined.rms_px;
  // T_a_b = T_b_a^-1: a right perturbation of T_b_a by xi is one of T_a_b by -Ad(T_b_a) xi.
  const geometry::Matrix6d A = geometry::adjoint(refined.T_world_camera);
  motion.covariance = A * refined.covariance * A.transpose();
  const auto inliers = static_cast<int>(motion.inlier.size());
  if (inliers < config.min_inliers || inliers < config.min_inlier_ratio * static_cast<double>(matches.size())) {
    return motion;
  }
  motion.spread = spreadOf(motion.inlier, problem, camera);
  motion.status = motion.spread < config.min_spread ? MotionStatus::kTooLittleSpread : MotionStatus::kConverged;
  return motion;
}

}  // namespace oikos::mapping
