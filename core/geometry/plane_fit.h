// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace oikos::geometry {

/// normal · p = offset_m, the normal of unit length.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset_m = 0.0;

  /// Positive on the side that the normal points to.
  [[nodiscard]] double distanceM(const Eigen::Vector3d& point) const { return normal.dot(point) - offset_m; }
};

enum class PlaneFitStatus {
  kTooFewPoints,  ///< fewer than 3
  kDegenerate,    ///< the points lie on a line, or in one place
  kFitted,
};

struct [[nodiscard]] PlaneFitResult {
  PlaneFitStatus status = PlaneFitStatus::kTooFewPoints;
  Plane plane;  ///< the normal's sign is arbitrary
  int points = 0;
  double rms_m = 0.0;  ///< of the distances
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double width_m = 0.0;  ///< standard deviation along the plane's narrower direction: what holds the normal
};

/// Least squares over orthogonal distances: the plane through the centroid across the direction of least spread.
class PlaneFit {
 public:
  void add(const Eigen::Vector3d& point);
  PlaneFitResult solve() const;

 private:
  int count_ = 0;
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();  ///< the first point: sums are taken from here
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
};

}  // namespace oikos::geometry
