// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/relative_pose_cost.h"

#include <algorithm>

#include "mapping/graph/pose_block.h"

namespace oikos::mapping {

namespace {

Eigen::Isometry3d fromBlock(const double* block) {
  PoseBlock copy;
  std::copy(block, block + 7, copy.begin());
  return fromPoseBlock(copy);
}

void store(double* jacobian, const geometry::Matrix6d& J) {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> out(jacobian);
  out << J, geometry::Vector6d::Zero();
}

}  // namespace

bool RelativePoseCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const Eigen::Isometry3d T_world_from = fromBlock(parameters[0]);
  const Eigen::Isometry3d T_world_to = fromBlock(parameters[1]);
  const Eigen::Isometry3d error = T_to_from_ * T_world_from.inverse() * T_world_to;
  const geometry::Vector6d xi = geometry::logSe3(error);
  Eigen::Map<geometry::Vector6d> r(residuals);
  r = sqrt_information_ * xi;
  if (jacobians == nullptr) {
    return true;
  }
  // error * exp(b): d xi = Jr^-1 b, Jr^-1 about I + ad(xi) / 2.
  geometry::Matrix6d Jr_inverse = geometry::Matrix6d::Identity();
  Jr_inverse.topLeftCorner<3, 3>() += 0.5 * geometry::skew(xi.tail<3>());
  Jr_inverse.bottomRightCorner<3, 3>() += 0.5 * geometry::skew(xi.tail<3>());
  Jr_inverse.topRightCorner<3, 3>() += 0.5 * geometry::skew(xi.head<3>());
  const geometry::Matrix6d by_to = sqrt_information_ * Jr_inverse;
  if (jacobians[0] != nullptr) {
    const geometry::Matrix6d by_from = -by_to * geometry::adjoint(T_world_to.inverse() * T_world_from);
    store(jacobians[0], by_from);
  }
  if (jacobians[1] != nullptr) {
    store(jacobians[1], by_to);
  }
  return true;
}

}  // namespace oikos::mapping
