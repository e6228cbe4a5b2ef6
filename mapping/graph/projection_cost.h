// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Geometry>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"

namespace oikos::mapping {

/// A pose as Ceres sees it: translation and quaternion (x y z w) of T_world_node; changed by T * exp(xi) to first order, xi = (translation,
/// rotation). The costs give their Jacobians by xi in the first six columns and zero in the seventh.
class RightPerturbedPose final : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 6; }
  bool Plus(const double* pose, const double* xi, double* moved) const override;
  bool PlusJacobian(const double* pose, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* xi) const override;
  bool MinusJacobian(const double* pose, double* jacobian) const override;
};

/// A landmark seen in another node; all that stays fixed during the adjustment.
struct Sighting {
  Eigen::Vector2d host_px;
  Eigen::Vector2d seen_px;
  geometry::Vector6d host_velocity;  ///< body twist (m/s, rad/s)
  geometry::Vector6d seen_velocity;
  double inverse_sigma_px = 1.0;
  double measured_inverse_depth = 0.0;       ///< of the depth image at seen_px, 1/m
  double inverse_sigma_inverse_depth = 0.0;  ///< 0: no reading
};

/// Residuals of one sighting, by the host's pose, the seeing node's pose, the landmark's inverse depth d in its host and the read-out
/// time. With the poses at the time of each pixel's row (T_w_h, T_w_s) and the host pixel's ray:
///   p = R_w_s^T (R_w_h ray + d (t_w_h - t_w_s))            the point in the seeing camera, times d
///   r = [ (pi(p) - seen_px) / sigma_px,  (d / p.z - measured) / sigma ]
class SightingCost final : public ceres::SizedCostFunction<3, 7, 7, 1, 1> {
 public:
  /// The camera must outlive the cost.
  SightingCost(const Sighting& sighting, const camera::PinholeCamera& camera) : sighting_(sighting), camera_(camera) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Sighting sighting_;
  const camera::PinholeCamera& camera_;
};

}  // namespace oikos::mapping
