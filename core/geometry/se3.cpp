// SPDX-License-Identifier: Apache-2.0
// Lie group helpers after Barfoot, "State Estimation for Robotics" (2017), chapter 7.
#include "core/geometry/se3.h"

#include <cmath>

namespace oikos::geometry {

namespace {

constexpr double kSmallAngle_rad = 1e-8;

/// The matrix V with expSe3((rho, phi)).translation() == V * rho.
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& phi_rad) {
  const double angle_rad = phi_rad.norm();
  const Eigen::Matrix3d W = skew(phi_rad);
  if (angle_rad < 1e-5) {
    return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  }
  const double sq = angle_rad * angle_rad;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle_rad)) / sq * W + (angle_rad - std::sin(angle_rad)) / (sq * angle_rad) * W * W;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d W;
  W << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return W;
}

Eigen::Matrix3d expSo3(const Eigen::Vector3d& omega_rad) {
  const double angle_rad = omega_rad.norm();
  if (angle_rad < kSmallAngle_rad) {
    return Eigen::Quaterniond(1.0, 0.5 * omega_rad.x(), 0.5 * omega_rad.y(), 0.5 * omega_rad.z()).normalized().toRotationMatrix();
  }
  return Eigen::AngleAxisd(angle_rad, omega_rad / angle_rad).toRotationMatrix();
}

Eigen::Vector3d logSo3(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sine = q.vec().norm();
  if (sine < kSmallAngle_rad) {
    return (q.w() < 0.0 ? -2.0 : 2.0) * q.vec();
  }
  const double angle_rad = q.w() < 0.0 ? -2.0 * std::atan2(sine, -q.w()) : 2.0 * std::atan2(sine, q.w());
  return angle_rad / sine * q.vec();
}

Eigen::Isometry3d expSe3(const Vector6d& xi) {
  const Eigen::Vector3d phi_rad = xi.tail<3>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = expSo3(phi_rad);
  T.translation() = leftJacobian(phi_rad) * xi.head<3>();
  return T;
}

Vector6d logSe3(const Eigen::Isometry3d& T) {
  Vector6d xi;
  xi.tail<3>() = logSo3(T.linear());
  xi.head<3>() = leftJacobian(xi.tail<3>()).partialPivLu().solve(T.translation());
  return xi;
}

Matrix6d adjoint(const Eigen::Isometry3d& T) {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = skew(T.translation()) * T.linear();
  return A;
}

Eigen::Isometry3d interpolate(const Eigen::Isometry3d& T_a_b, const Eigen::Isometry3d& T_a_c, double fraction) {
  const Vector6d xi = logSe3(T_a_b.inverse() * T_a_c);
  return T_a_b * expSe3(fraction * xi);
}

}  // namespace oikos::geometry
