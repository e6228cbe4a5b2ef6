// SPDX-License-Identifier: Apache-2.0
// Residuals of a sighting with p = T_world_camera^-1 * point_world:
//   r_px = (pi(p) - pixel) / pixel_sigma        r_z = (1 / p.z - 1 / depth) / sigma_inverse_depth
#include "mapping/odometry/pose_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/camera/depth_noise.h"

namespace oikos::mapping {

namespace {

constexpr int kMinInliers = 6;

struct Residual {
  bool valid = false;
  bool has_depth = false;
  Eigen::Vector3d whitened = Eigen::Vector3d::Zero();  ///< u, v, inverse depth
  Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
};

/// The camera with its motion.
struct Motion {
  Eigen::Isometry3d T_camera_world;
  geometry::Vector6d velocity;
};

Residual residualOf(const PointSighting& s, const camera::PinholeCamera& camera, const Motion& motion) {
  Residual r;
  Eigen::Vector3d p = motion.T_camera_world * s.point_world;
  p -= s.time_s * (motion.velocity.head<3>() + motion.velocity.tail<3>().cross(p));
  if (p.z() < 0.05) {
    return r;
  }
  r.valid = true;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << -Eigen::Matrix3d::Identity(), geometry::skew(p);
  const double z_inverse = 1.0 / p.z();
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << camera.fx * z_inverse, 0.0, -camera.fx * p.x() * z_inverse * z_inverse, 0.0, camera.fy * z_inverse,
      -camera.fy * p.y() * z_inverse * z_inverse;
  r.whitened.head<2>() = (camera.project(p) - s.pixel) / s.pixel_sigma_px;
  r.J.topRows<2>() = by_point * by_pose / s.pixel_sigma_px;
  if (s.depth_m > 0.0) {
    const double sigma = camera::inverseDepthSigma(s.depth_m);
    r.has_depth = true;
    r.whitened.z() = (z_inverse - 1.0 / s.depth_m) / sigma;
    r.J.row(2) = -z_inverse * z_inverse / sigma * by_pose.row(2);
  }
  return r;
}

struct NormalEquations {
  geometry::Matrix6d H = geometry::Matrix6d::Zero();
  geometry::Vector6d g = geometry::Vector6d::Zero();
};

double huberWeight(double norm, double limit) {
  return norm <= limit ? 1.0 : limit / norm;
}

NormalEquations linearise(const std::vector<PointSighting>& sightings, const camera::PinholeCamera& camera, const Motion& motion,
                          const std::vector<char>& use, const PoseSolverConfig& config) {
  NormalEquations n;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Residual r = use[i] != 0 ? residualOf(sightings[i], camera, motion) : Residual{};
    if (!r.valid) {
      continue;
    }
    const double weight = huberWeight(r.whitened.head<2>().norm(), config.huber_sigmas);
    n.H.noalias() += weight * r.J.topRows<2>().transpose() * r.J.topRows<2>();
    n.g.noalias() += weight * r.J.topRows<2>().transpose() * r.whitened.head<2>();
    if (r.has_depth) {
      const double depth_weight = config.depth_weight * weight * huberWeight(std::abs(r.whitened.z()), config.huber_sigmas);
      n.H.noalias() += depth_weight * r.J.row(2).transpose() * r.J.row(2);
      n.g.noalias() += depth_weight * r.whitened.z() * r.J.row(2).transpose();
    }
  }
  return n;
}

void markInliers(const std::vector<PointSighting>& sightings, const camera::PinholeCamera& camera, double outlier_sigmas,
                 const geometry::Vector6d& velocity, PoseSolution& solution) {
  const Motion motion{solution.T_world_camera.inverse(), velocity};
  solution.inliers = 0;
  double squares_px = 0.0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Residual r = residualOf(sightings[i], camera, motion);
    const bool inlier =
        r.valid && r.whitened.head<2>().norm() < outlier_sigmas && (!r.has_depth || std::abs(r.whitened.z()) < 3.0 * outlier_sigmas);
    solution.inlier[i] = inlier ? 1 : 0;
    if (inlier) {
      ++solution.inliers;
      squares_px += (r.whitened.head<2>() * sightings[i].pixel_sigma_px).squaredNorm();
    }
  }
  solution.rms_px = solution.inliers > 0 ? std::sqrt(squares_px / solution.inliers) : 0.0;
}

bool iterate(const std::vector<PointSighting>& sightings, const camera::PinholeCamera& camera, const PoseSolverConfig& config,
             const geometry::Vector6d& velocity, PoseSolution& solution) {
  for (int iteration = 0; iteration < config.max_iterations; ++iteration) {
    const NormalEquations n = linearise(sightings, camera, {solution.T_world_camera.inverse(), velocity}, solution.inlier, config);
    geometry::Matrix6d H = n.H;
    H.diagonal().array() += 1e-9 * H.trace();
    const geometry::Vector6d step = -H.ldlt().solve(n.g);
    if (!step.allFinite() || step.norm() > 2.0) {
      return false;
    }
    solution.T_world_camera = solution.T_world_camera * geometry::expSe3(step);
    if (step.norm() < config.converged) {
      break;
    }
  }
  return true;
}

}  // namespace

PoseSolution solvePose(const std::vector<PointSighting>& sightings, const camera::PinholeCamera& camera,
                       const Eigen::Isometry3d& T_world_camera_start, const PoseSolverConfig& config, const geometry::Vector6d& velocity) {
  PoseSolution solution;
  solution.T_world_camera = T_world_camera_start;
  solution.inlier.assign(sightings.size(), 1);
  if (sightings.size() < kMinInliers) {
    return solution;
  }
  // A wide gate first: the start may be off by several pixels.
  for (const double gate : {4.0 * config.outlier_sigmas, config.outlier_sigmas, config.outlier_sigmas}) {
    if (!iterate(sightings, camera, config, velocity, solution)) {
      solution.T_world_camera = T_world_camera_start;
      solution.status = PoseStatus::kDegenerate;
      return solution;
    }
    markInliers(sightings, camera, gate, velocity, solution);
    if (solution.inliers < kMinInliers) {
      solution.status = PoseStatus::kTooFewSightings;
      return solution;
    }
  }
  const NormalEquations n = linearise(sightings, camera, {solution.T_world_camera.inverse(), velocity}, solution.inlier, config);
  const Eigen::SelfAdjointEigenSolver<geometry::Matrix6d> eigen(n.H);
  if (eigen.eigenvalues().minCoeff() < 1e-9 * eigen.eigenvalues().maxCoeff()) {
    solution.status = PoseStatus::kDegenerate;
    return solution;
  }
  double mean_sigma_px = 0.0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    mean_sigma_px += solution.inlier[i] != 0 ? sightings[i].pixel_sigma_px / solution.inliers : 0.0;
  }
  const double scale = std::max(1.0, solution.rms_px * solution.rms_px / (2.0 * mean_sigma_px * mean_sigma_px));
  solution.covariance = scale * n.H.inverse();
  solution.T_world_camera.linear() = Eigen::Quaterniond(solution.T_world_camera.linear()).normalized().toRotationMatrix();
  solution.status = PoseStatus::kConverged;
  return solution;
}

}  // namespace oikos::mapping
