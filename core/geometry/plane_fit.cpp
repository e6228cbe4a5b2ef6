// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace oikos::geometry {

void PlaneFit::add(const Eigen::Vector3d& point) {
  if (count_ == 0) {
    anchor_ = point;
  }
  ++count_;
  const Eigen::Vector3d from_anchor = point - anchor_;
  sum_ += from_anchor;
  squares_ += from_anchor * from_anchor.transpose();
}

PlaneFitResult PlaneFit::solve() const {
  PlaneFitResult result;
  result.points = count_;
  if (count_ < 3) {
    return result;
  }
  const Eigen::Vector3d mean = sum_ / count_;
  const Eigen::Matrix3d covariance = squares_ / count_ - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d spread = solver.eigenvalues();
  if (!(spread[1] > 1e-12 * std::max(spread[2], 1e-12)) || !(spread[1] > 1e-18)) {
    result.status = PlaneFitStatus::kDegenerate;
    return result;
  }
  result.plane.normal = solver.eigenvectors().col(0);
  result.centroid = anchor_ + mean;
  result.plane.offset_m = result.plane.normal.dot(result.centroid);
  result.width_m = std::sqrt(spread[1]);
  result.rms_m = std::sqrt(std::max(0.0, spread[0]));
  result.status = PlaneFitStatus::kFitted;
  return result;
}

}  // namespace oikos::geometry
