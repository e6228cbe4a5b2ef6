// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>

namespace oikos::geometry {

enum class RigidAlignmentStatus {
  kTooFewPoints,  ///< fewer than three pairs with a weight above zero
  kNonFinite,     ///< NaN or infinity in a point or a weight
  kCollinear,     ///< the pairs lie on a line or in one point: the rotation is not determined
  kAligned,
};

enum class AlignmentScale {
  kFixed,  ///< a rigid motion
  kFree,   ///< a similarity; for estimates without metric scale
};

struct [[nodiscard]] RigidAlignment {
  RigidAlignmentStatus status = RigidAlignmentStatus::kTooFewPoints;
  /// Rotation and translation of p_a = scale * R_a_b * p_b + t_a_b. When `status` is kCollinear: one of many equally good ones.
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  double scale = 1.0;         ///< 1 unless AlignmentScale::kFree was asked for
  double rms_m = 0.0;         ///< weighted root mean square of the residuals' lengths; true for kCollinear, too
  double conditioning = 0.0;  ///< second / greatest singular value of the cross-covariance; 0 = a line, 1 = as long as wide

  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point_b) const {
    return scale * (T_a_b.linear() * point_b) + T_a_b.translation();
  }
};

/// Least-squares motion between paired points, in closed form (Arun, Huang & Blostein 1987, doi:10.1109/TPAMI.1987.4767965, with
/// the correction for reflections and the scale of Umeyama 1991, doi:10.1109/34.88573). `weights` are >= 0, one a pair; empty:
/// all equal. A negative weight or unequal lengths break the contract. Linear in the number of pairs; allocates nothing.
RigidAlignment alignRigid(std::span<const Eigen::Vector3d> points_a, std::span<const Eigen::Vector3d> points_b,
                          std::span<const double> weights = {}, AlignmentScale scale = AlignmentScale::kFixed);

}  // namespace oikos::geometry
