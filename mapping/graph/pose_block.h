// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace oikos::mapping {

/// Translation and quaternion (x y z w): a pose as the optimisers hold it.
using PoseBlock = std::array<double, 7>;

[[nodiscard]] inline PoseBlock toPoseBlock(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()};
}

[[nodiscard]] inline Eigen::Isometry3d fromPoseBlock(const PoseBlock& block) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(block[6], block[3], block[4], block[5]).normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d(block[0], block[1], block[2]);
  return T;
}

}  // namespace oikos::mapping
