// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/camera_prior.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace oikos::registration {

StepMatrix planarCovariance(const CameraPrior& prior) {
  StepMatrix covariance = StepMatrix::Zero(3, 3);
  covariance.diagonal() << prior.sigma_m * prior.sigma_m, prior.sigma_m * prior.sigma_m, prior.sigma_rad * prior.sigma_rad;
  return covariance;
}

Step stepToPrior(const CameraPrior& prior, const Eigen::Isometry3d& T_map_camera) {
  Step back(3);
  back.head<2>() = (prior.T_map_camera * prior.robot_camera - T_map_camera * prior.robot_camera).head<2>();
  const Eigen::Matrix3d R = prior.T_map_camera.linear() * T_map_camera.linear().transpose();
  back(2) = std::atan2(R(1, 0), R(0, 0));
  return back;
}

geometry::Matrix6d cameraCovariance(const StepMatrix& planar, const UprightSigma& upright, const Eigen::Isometry3d& T_map_camera,
                                    const Eigen::Vector3d& robot_camera) {
  geometry::Matrix6d about_robot = geometry::Matrix6d::Zero();
  constexpr std::array<Eigen::Index, 3> kPlanarIndex = {0, 1, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      about_robot(kPlanarIndex[i], kPlanarIndex[j]) = planar(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  about_robot(2, 2) = upright.height_m * upright.height_m;
  about_robot(3, 3) = about_robot(4, 4) = upright.tilt_rad * upright.tilt_rad;
  const Eigen::Isometry3d T_map_robot(Eigen::Translation3d(T_map_camera * robot_camera));
  const geometry::Matrix6d A = geometry::adjoint(T_map_camera.inverse() * T_map_robot);
  return A * about_robot * A.transpose();
}

}  // namespace oikos::registration
