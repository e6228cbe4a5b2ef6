// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace oikos::bench {

/// What other libraries' point-to-plane ICP gets to register, in the camera's frame, in m: the scan's points, and the model's with normals.
struct IcpClouds {
  std::vector<Eigen::Vector3d> scan;
  std::vector<Eigen::Vector3d> model;
  std::vector<Eigen::Vector3d> model_normals;
};

/// The motion of the scan onto the model; the scan's normals are estimated from 20 neighbours, at most 50 steps are made.
/// PCL's `IterativeClosestPointWithNormals`.
Eigen::Isometry3d alignByPcl(const IcpClouds& clouds, double correspondence_m);

/// Open3D's `RegistrationICP` with `TransformationEstimationPointToPlane`; its own default criteria of convergence.
Eigen::Isometry3d alignByOpen3d(const IcpClouds& clouds, double correspondence_m);

}  // namespace oikos::bench
