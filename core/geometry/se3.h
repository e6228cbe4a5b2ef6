// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace oikos::geometry {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The matrix of the cross product: `skew(a) * b == a.cross(b)`.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Exponential of so(3): the rotation about `omega_rad` by its length.
[[nodiscard]] Eigen::Matrix3d expSo3(const Eigen::Vector3d& omega_rad);
/// Inverse of expSo3; the angle is in [0, pi].
[[nodiscard]] Eigen::Vector3d logSo3(const Eigen::Matrix3d& R);

/// Exponential of se(3), xi = (translation, rotation). Perturbations stand on the right: T * expSe3(xi).
[[nodiscard]] Eigen::Isometry3d expSe3(const Vector6d& xi);
/// Inverse of expSe3.
[[nodiscard]] Vector6d logSe3(const Eigen::Isometry3d& T);

/// Adjoint: T * expSe3(xi) == expSe3(adjoint(T) * xi) * T.
[[nodiscard]] Matrix6d adjoint(const Eigen::Isometry3d& T);

/// The pose on the geodesic from `T_a_b` (fraction 0) to `T_a_c` (fraction 1).
[[nodiscard]] Eigen::Isometry3d interpolate(const Eigen::Isometry3d& T_a_b, const Eigen::Isometry3d& T_a_c, double fraction);

}  // namespace oikos::geometry
