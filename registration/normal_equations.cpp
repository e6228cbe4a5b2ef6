// SPDX-License-Identifier: Apache-2.0
// Chen & Medioni, "Object modelling by registration of multiple range images" (1992, doi:10.1016/0262-8856(92)90066-C), with the
// test of Hatleskog & Alexis, "Probabilistic Degeneracy Detection for Point-to-Plane Error Minimization" (RA-L 2024), in mind: a direction
// counts as observed if its information is a multiple of what turned normals would make of it. Differs in that the normals are the
// model's, so that one deviation stands for the model's error, and that the multiple is asked for instead of a probability.
#include "registration/normal_equations.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>

namespace oikos::registration {

namespace {

/// Points of one part whose normals lie about the same way are off together.
std::array<int, 5> surfaceOf(const Pair& pair) {
  const Eigen::Vector3i facing = (1.5 * pair.normal_map).array().round().cast<int>();
  return {pair.part, pair.is_edge ? 1 : 0, facing.x(), facing.y(), facing.z()};
}

}  // namespace

Step jacobianOf(const Pair& pair, const Twists& twists, const Eigen::Vector3d& pivot_map) {
  Eigen::Matrix<double, 6, 1> row;
  row << pair.normal_map, (pair.model_map - pivot_map).cross(pair.normal_map);
  return -twists.transpose() * row;
}

NormalEquations sumUp(const std::vector<Pair>& pairs, const Motion& motion, const ErrorModel& errors) {
  const Eigen::Index size = motion.dimension();
  NormalEquations sum{StepMatrix::Zero(size, size), Step::Zero(size), StepMatrix::Zero(size, size), StepMatrix::Zero(size, size)};
  const Eigen::Vector3d pivot_map = motion.pivot_map();
  std::map<int, Twists> twists_of_part;
  std::map<std::array<int, 5>, Step> shifts;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 8> velocity(3, size);
  for (const Pair& pair : pairs) {
    const auto known = twists_of_part.find(pair.part);
    const Twists& twists =
        known != twists_of_part.end() ? known->second : twists_of_part.emplace(pair.part, motion.twistsOf(pair.part)).first->second;
    const double sigma_m = std::hypot(pair.sigma_m, errors.surface_sigma_m);
    const double residual_m = pair.residual_m();
    const double kernel_m = std::max(3.0 * sigma_m, errors.kernel_m);
    const double share = 1.0 / (1.0 + residual_m * residual_m / (kernel_m * kernel_m));
    const double weight = share * share / (sigma_m * sigma_m);
    const Step J = jacobianOf(pair, twists, pivot_map);
    sum.H += weight * J * J.transpose();
    sum.g += weight * residual_m * J;
    const Eigen::Vector3d arm = pair.model_map - pivot_map;
    for (Eigen::Index i = 0; i < size; ++i) {
      velocity.col(i) = twists.col(i).head<3>() + Eigen::Vector3d(twists.col(i).tail<3>()).cross(arm);
    }
    // A normal turned by a small angle takes up what moves along the surface; an outline has no other side to turn to.
    const double normal_sigma_rad = pair.is_edge ? 0.0 : errors.normal_sigma_rad;
    sum.H_of_noise += weight * normal_sigma_rad * normal_sigma_rad * (velocity.transpose() * velocity - J * J.transpose());
    const auto shift = shifts.try_emplace(surfaceOf(pair), Step::Zero(size)).first;
    shift->second += weight * errors.surface_sigma_m * J;
    sum.weight += weight * sigma_m * sigma_m;
    sum.squares += weight * residual_m * residual_m;
    sum.squares_m += weight * sigma_m * sigma_m * residual_m * residual_m;
    if (std::abs(residual_m) < kernel_m) {
      ++(pair.is_edge ? sum.edge_inliers : sum.inliers);
    }
  }
  for (const auto& [surface, shift] : shifts) {
    sum.surfaces += shift * shift.transpose();
  }
  return sum;
}

Observability observe(const NormalEquations& equations) {
  const Eigen::Index size = equations.g.size();
  const double floor = 1e-9 * (equations.H_of_noise.trace() + equations.H.trace()) / static_cast<double>(size) + 1e-12;
  const StepMatrix noise = equations.H_of_noise + floor * StepMatrix::Identity(size, size);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(equations.H), Eigen::MatrixXd(noise));
  Observability observability;
  observability.ratio.assign(eigen.eigenvalues().begin(), eigen.eigenvalues().end());
  observability.directions = eigen.eigenvectors();
  return observability;
}

}  // namespace oikos::registration
