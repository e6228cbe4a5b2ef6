// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Geometry>

#include "core/geometry/se3.h"

namespace oikos::mapping {

/// Residual of an edge of the pose graph, by the poses of its two nodes (blocks as RightPerturbedPose has them):
///   r = W * log(T_from_to^-1 * T_world_from^-1 * T_world_to),   W^T W = information.
/// Its Jacobians hold to first order of the residual, which is small wherever the kernel lets it count.
class RelativePoseCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  RelativePoseCost(const Eigen::Isometry3d& T_from_to, const geometry::Matrix6d& sqrt_information)
      : T_to_from_(T_from_to.inverse()), sqrt_information_(sqrt_information) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Eigen::Isometry3d T_to_from_;
  geometry::Matrix6d sqrt_information_;
};

}  // namespace oikos::mapping
