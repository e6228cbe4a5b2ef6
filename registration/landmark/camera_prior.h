// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "core/geometry/se3.h"
#include "registration/motion.h"
#include "registration/normal_equations.h"

namespace oikos::registration {

/// Where the camera is believed to be. It stands upright as it should: only x, y and yaw about map z are in doubt (S216, S219).
struct CameraPrior {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3d robot_camera = Eigen::Vector3d::Zero();  ///< the robot's middle, about which it turns
  double sigma_m = 0.05;                                   ///< of the robot's x and y each
  double sigma_rad = 0.0524;                               ///< of its yaw
};

/// Of x, y and yaw about the robot's middle, along the axes of map.
[[nodiscard]] StepMatrix planarCovariance(const CameraPrior& prior);

/// The step of x, y and yaw from a camera's pose back to the prior's.
[[nodiscard]] Step stepToPrior(const CameraPrior& prior, const Eigen::Isometry3d& T_map_camera);

/// How well height and tilt are known, which no planar correction changes.
struct UprightSigma {
  double height_m = 0.0;
  double tilt_rad = 0.0;
};

/// Of the right perturbation of T_map_camera (m, rad), from that of x, y and yaw about the robot's middle.
[[nodiscard]] geometry::Matrix6d cameraCovariance(const StepMatrix& planar, const UprightSigma& upright,
                                                  const Eigen::Isometry3d& T_map_camera, const Eigen::Vector3d& robot_camera);

}  // namespace oikos::registration
