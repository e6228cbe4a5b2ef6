// SPDX-License-Identifier: Apache-2.0
// S. Umeyama, "Least-squares estimation of transformation parameters between two point patterns", IEEE TPAMI 13(4), 1991.
// Differs in that the pairs are weighted and that a rotation left open by the points is reported.
#include "core/geometry/rigid_alignment.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/error.h"

namespace oikos::geometry {

namespace {

/// Below it, the points' extent across their line is less than 1e-5 of that along it: rounding, not shape.
constexpr double kMinConditioning = 1e-10;

struct Pairs {
  std::span<const Eigen::Vector3d> points_a;
  std::span<const Eigen::Vector3d> points_b;
  std::span<const double> weights;

  [[nodiscard]] std::size_t size() const { return points_a.size(); }
  [[nodiscard]] double weight(std::size_t i) const { return weights.empty() ? 1.0 : weights[i]; }
};

struct Moments {
  double weight_sum = 0.0;
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero();
  Eigen::Matrix3d cross_covariance = Eigen::Matrix3d::Zero();  ///< sum of w (a - mean_a)(b - mean_b)^T / sum of w
  double variance_b = 0.0;
};

RigidAlignmentStatus check(const Pairs& pairs) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double weight = pairs.weight(i);
    if (!std::isfinite(weight) || !pairs.points_a[i].allFinite() || !pairs.points_b[i].allFinite()) {
      return RigidAlignmentStatus::kNonFinite;
    }
    OIKOS_CHECK(weight >= 0.0);
    used += weight > 0.0 ? 1 : 0;
  }
  return used < 3 ? RigidAlignmentStatus::kTooFewPoints : RigidAlignmentStatus::kAligned;
}

Moments momentsOf(const Pairs& pairs) {
  Moments moments;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    moments.weight_sum += pairs.weight(i);
    moments.mean_a += pairs.weight(i) * pairs.points_a[i];
    moments.mean_b += pairs.weight(i) * pairs.points_b[i];
  }
  moments.mean_a /= moments.weight_sum;
  moments.mean_b /= moments.weight_sum;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double share = pairs.weight(i) / moments.weight_sum;
    const Eigen::Vector3d centred_b = pairs.points_b[i] - moments.mean_b;
    moments.cross_covariance += share * (pairs.points_a[i] - moments.mean_a) * centred_b.transpose();
    moments.variance_b += share * centred_b.squaredNorm();
  }
  return moments;
}

/// The residuals themselves rather than Umeyama's closed form of their sum, which cancels to noise when the fit is good.
double rmsOf(const Pairs& pairs, const RigidAlignment& alignment, double weight_sum) {
  double sum_sq = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    sum_sq += pairs.weight(i) * (pairs.points_a[i] - alignment.apply(pairs.points_b[i])).squaredNorm();
  }
  return std::sqrt(sum_sq / weight_sum);
}

}  // namespace

RigidAlignment alignRigid(std::span<const Eigen::Vector3d> points_a, std::span<const Eigen::Vector3d> points_b,
                          std::span<const double> weights, AlignmentScale scale) {
  OIKOS_CHECK(points_a.size() == points_b.size());
  OIKOS_CHECK(weights.empty() || weights.size() == points_a.size());
  const Pairs pairs{points_a, points_b, weights};
  RigidAlignment alignment;
  alignment.status = check(pairs);
  if (alignment.status != RigidAlignmentStatus::kAligned) {
    return alignment;
  }
  const Moments moments = momentsOf(pairs);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments.cross_covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d singular = svd.singularValues();
  const double reflection = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d signs(1.0, 1.0, reflection);
  alignment.conditioning = singular[0] > 0.0 ? singular[1] / singular[0] : 0.0;
  if (alignment.conditioning < kMinConditioning) {
    alignment.status = RigidAlignmentStatus::kCollinear;
  }
  if (scale == AlignmentScale::kFree && moments.variance_b > 0.0) {
    alignment.scale = singular.dot(signs) / moments.variance_b;
  }
  alignment.T_a_b.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  alignment.T_a_b.translation() = moments.mean_a - alignment.scale * (alignment.T_a_b.linear() * moments.mean_b);
  alignment.rms_m = rmsOf(pairs, alignment, moments.weight_sum);
  return alignment;
}

}  // namespace oikos::geometry
