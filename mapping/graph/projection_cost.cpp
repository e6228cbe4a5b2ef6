// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/projection_cost.h"

#include <array>

namespace oikos::mapping {

namespace {

using PoseJacobian = Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>>;
using ScalarJacobian = Eigen::Map<Eigen::Vector3d>;

/// A pose block and its motion until a row is exposed.
struct MovingPose {
  Eigen::Matrix3d R;  ///< at the stamp
  Eigen::Vector3d t;
  Eigen::Matrix3d turn;   ///< exp(omega * time)
  Eigen::Vector3d shift;  ///< v * time

  MovingPose(const double* block, const geometry::Vector6d& velocity, double time_s)
      : R(Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(block + 3)).normalized().toRotationMatrix()),
        t(Eigen::Map<const Eigen::Vector3d>(block)),
        turn(time_s == 0.0 ? Eigen::Matrix3d::Identity() : geometry::expSo3(velocity.tail<3>() * time_s)),
        shift(velocity.head<3>() * time_s) {}
};

}  // namespace

bool RightPerturbedPose::Plus(const double* pose, const double* xi, double* moved) const {
  const Eigen::Quaterniond q(Eigen::Map<const Eigen::Vector4d>(pose + 3));
  const Eigen::Map<const Eigen::Vector3d> rho(xi);
  const Eigen::Map<const Eigen::Vector3d> phi(xi + 3);
  Eigen::Map<Eigen::Vector3d> t_moved(moved);
  Eigen::Map<Eigen::Vector4d> q_moved(moved + 3);
  t_moved = Eigen::Map<const Eigen::Vector3d>(pose) + q * rho;
  q_moved = (q * Eigen::Quaterniond(geometry::expSo3(phi))).normalized().coeffs();
  return true;
}

bool RightPerturbedPose::PlusJacobian(const double* /*pose*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topRows<6>().setIdentity();
  return true;
}

bool RightPerturbedPose::Minus(const double* y, const double* x, double* xi) const {
  const Eigen::Quaterniond q_x(Eigen::Map<const Eigen::Vector4d>(x + 3));
  const Eigen::Quaterniond q_y(Eigen::Map<const Eigen::Vector4d>(y + 3));
  Eigen::Map<Eigen::Vector3d> rho(xi);
  Eigen::Map<Eigen::Vector3d> phi(xi + 3);
  rho = q_x.conjugate() * (Eigen::Map<const Eigen::Vector3d>(y) - Eigen::Map<const Eigen::Vector3d>(x));
  phi = geometry::logSo3((q_x.conjugate() * q_y).toRotationMatrix());
  return true;
}

bool RightPerturbedPose::MinusJacobian(const double* /*pose*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.leftCols<6>().setIdentity();
  return true;
}

bool SightingCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const Sighting& s = sighting_;
  const double d = parameters[2][0];
  const double readout_s = parameters[3][0];
  const double host_phase = s.host_px.y() / camera_.height - 0.5;
  const double seen_phase = s.seen_px.y() / camera_.height - 0.5;
  const MovingPose host(parameters[0], s.host_velocity, host_phase * readout_s);
  const MovingPose seen(parameters[1], s.seen_velocity, seen_phase * readout_s);
  const Eigen::Vector3d ray = host.turn * camera_.ray(s.host_px.x(), s.host_px.y());
  const Eigen::Matrix3d R_s_h = seen.R.transpose() * host.R;
  const Eigen::Vector3d t_s_h = seen.R.transpose() * (host.t - seen.t);
  const Eigen::Vector3d b = R_s_h * (ray + d * host.shift) + d * t_s_h;  // in the seeing node at its stamp
  const Eigen::Vector3d p = seen.turn.transpose() * (b - d * seen.shift);
  Eigen::Map<Eigen::Vector3d> r(residuals);
  const bool in_front = p.z() > 0.02;
  if (!in_front) {
    r.setConstant(1e3);  // the kernel leaves nothing of it
  } else {
    r.head<2>() = (camera_.project(p) - s.seen_px) * s.inverse_sigma_px;
    r.z() = (d / p.z() - s.measured_inverse_depth) * s.inverse_sigma_inverse_depth;
  }
  if (jacobians == nullptr) {
    return true;
  }
  Eigen::Matrix3d by_point = Eigen::Matrix3d::Zero();
  if (in_front) {
    const double z_inverse = 1.0 / p.z();
    by_point.row(0) << camera_.fx * z_inverse, 0.0, -camera_.fx * p.x() * z_inverse * z_inverse;
    by_point.row(1) << 0.0, camera_.fy * z_inverse, -camera_.fy * p.y() * z_inverse * z_inverse;
    by_point.topRows<2>() *= s.inverse_sigma_px;
    by_point(2, 2) = -d * z_inverse * z_inverse * s.inverse_sigma_inverse_depth;
  }
  const Eigen::Matrix3d by_b = by_point * seen.turn.transpose();
  if (jacobians[0] != nullptr) {
    PoseJacobian J(jacobians[0]);
    const Eigen::Matrix3d by_host = by_b * R_s_h;
    J << d * by_host, -by_host * geometry::skew(ray + d * host.shift), Eigen::Vector3d::Zero();
  }
  if (jacobians[1] != nullptr) {
    PoseJacobian J(jacobians[1]);
    J << -d * by_b, by_b * geometry::skew(b), Eigen::Vector3d::Zero();
  }
  if (jacobians[2] != nullptr) {
    ScalarJacobian J(jacobians[2]);
    J = by_b * (R_s_h * host.shift + t_s_h - seen.shift);
    J.z() += in_front ? s.inverse_sigma_inverse_depth / p.z() : 0.0;
  }
  if (jacobians[3] != nullptr) {
    const Eigen::Vector3d host_rate = R_s_h * (s.host_velocity.tail<3>().cross(ray) + d * s.host_velocity.head<3>());
    const Eigen::Vector3d seen_rate = s.seen_velocity.tail<3>().cross(p) + seen.turn.transpose() * s.seen_velocity.head<3>() * d;
    ScalarJacobian J(jacobians[3]);
    J = host_phase * by_b * host_rate - seen_phase * by_point * seen_rate;
  }
  return true;
}

}  // namespace oikos::mapping
