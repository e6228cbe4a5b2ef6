// SPDX-License-Identifier: Apache-2.0
// Point-to-plane residuals, summed up. Included by this folder's sources and its tests only.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "registration/motion.h"
#include "registration/pairs.h"

namespace oikos::registration {

using StepMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 8, 8>;

struct ErrorModel {
  double surface_sigma_m = 0.005;   ///< how far a surface is from where the model has it, all of its points together
  double normal_sigma_rad = 0.026;  ///< and how far turned
  double kernel_m = 0.015;          ///< width of the robust kernel, at least three deviations of the reading
};

/// Residual of a pair, with the model's point p about the pivot and moved by B * step, B the twists of its part:
///   r(step) = n · (s - p) - (n · B_translation + (p - pivot) × n · B_rotation) * step
struct NormalEquations {
  StepMatrix H;           ///< sum of J^T J / sigma^2, weighted
  Step g;                 ///< sum of J^T r / sigma^2: the step is -H^-1 g
  StepMatrix H_of_noise;  ///< what of H wrong normals alone would make
  StepMatrix surfaces;    ///< sum over surfaces of c c^T, c what a shift of the surface by its deviation does to g
  double weight = 0.0;
  double squares = 0.0;  ///< of residuals, weighted, in deviations
  double squares_m = 0.0;
  int inliers = 0;       ///< on surfaces, within the kernel
  int edge_inliers = 0;  ///< on outlines
};

/// Geman & McClure's kernel; its scale comes from outside and shrinks from coarse to fine.
[[nodiscard]] NormalEquations sumUp(const std::vector<Pair>& pairs, const Motion& motion, const ErrorModel& errors);

/// J of one pair.
[[nodiscard]] Step jacobianOf(const Pair& pair, const Twists& twists, const Eigen::Vector3d& pivot_map);

/// Directions in step space with how well each is observed, the worst first: information over what noise on the normals would feign.
struct Observability {
  std::vector<double> ratio;
  StepMatrix directions;  ///< columns v with v^T H v = ratio, and v^T H_of_noise v = 1
};
[[nodiscard]] Observability observe(const NormalEquations& equations);

}  // namespace oikos::registration
