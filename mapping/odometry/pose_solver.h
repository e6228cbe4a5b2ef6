// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"

namespace oikos::mapping {

/// A point of known place and where the camera saw it.
struct PointSighting {
  Eigen::Vector3d point_world;
  Eigen::Vector2d pixel;
  double depth_m;         ///< the depth image's reading there; NaN = none
  double pixel_sigma_px;  ///< of the place's projection and of the sighting together
  double time_s = 0.0;    ///< exposure of the pixel's row after the stamp (rolling shutter)
};

struct PoseSolverConfig {
  int max_iterations = 12;
  double converged = 1e-6;      ///< a step shorter than this (m and rad together) ends the iteration
  double huber_sigmas = 1.5;    ///< beyond it a residual pulls with constant force
  double outlier_sigmas = 4.0;  ///< beyond it a sighting is an outlier
  double depth_weight = 0.3;    ///< of the depth residuals' information: readings of one frame share their errors

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_iterations", max_iterations);
    visitor("converged", converged);
    visitor("huber_sigmas", huber_sigmas);
    visitor("outlier_sigmas", outlier_sigmas);
    visitor("depth_weight", depth_weight);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class PoseStatus { kTooFewSightings, kDegenerate, kConverged };

struct [[nodiscard]] PoseSolution {
  PoseStatus status = PoseStatus::kTooFewSightings;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad), scaled by the residual
  std::vector<char> inlier;                                    ///< one a sighting
  int inliers = 0;
  double rms_px = 0.0;  ///< reprojection error of the inliers, per coordinate pair
};

/// The camera pose that best explains sightings of known points: reprojection and, where there is one, depth residual, weighted by
/// their noise, with Huber's kernel; Gauss-Newton over SE(3) from `T_world_camera_start`. A sighting farther out than
/// `outlier_sigmas` is left out of the last iterations. `velocity`: the camera's body twist (m/s, rad/s) during the read-out; the pose
/// returned is that at the stamp.
PoseSolution solvePose(const std::vector<PointSighting>& sightings, const camera::PinholeCamera& camera,
                       const Eigen::Isometry3d& T_world_camera_start, const PoseSolverConfig& config,
                       const geometry::Vector6d& velocity = geometry::Vector6d::Zero());

}  // namespace oikos::mapping
