// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/up_direction.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace oikos::mapping {

namespace {

constexpr double kTolerance_sine = 0.174;  // 10°
constexpr double kSearchStep_rad = 0.08;   // half the tolerance's width

struct Votes {
  double along = 0.0;
  double across = 0.0;
};

Votes countVotes(const std::vector<SurfaceElement>& surface, const Eigen::Vector3d& up) {
  Votes votes;
  const double along_cosine = std::sqrt(1.0 - kTolerance_sine * kTolerance_sine);
  for (const SurfaceElement& element : surface) {
    const double cosine = std::fabs(element.normal_world.dot(up));
    votes.along += cosine > along_cosine ? 1.0 : 0.0;
    votes.across += cosine < kTolerance_sine ? 1.0 : 0.0;
  }
  return votes;
}

/// Faces across a direction fix it in one way only, faces along it in both; near image-up a direction needs fewer votes.
double score(const Votes& votes, double cosine_to_image_up) {
  return (votes.along + 0.5 * votes.across) * cosine_to_image_up;
}

/// Directions on rings around image-up.
std::vector<Eigen::Vector3d> listDirections(const UpPrior& prior) {
  const Eigen::Vector3d side = prior.image_up_world.unitOrthogonal();
  std::vector<Eigen::Vector3d> directions{prior.image_up_world};
  for (double tilt = kSearchStep_rad; tilt <= prior.max_tilt_rad; tilt += kSearchStep_rad) {
    const int count = static_cast<int>(std::ceil(2.0 * std::numbers::pi * std::sin(tilt) / kSearchStep_rad));
    for (int i = 0; i < count; ++i) {
      const Eigen::AngleAxisd around(2.0 * std::numbers::pi * i / count, prior.image_up_world);
      directions.emplace_back(around * (Eigen::AngleAxisd(tilt, side) * prior.image_up_world));
    }
  }
  return directions;
}

/// Least squares over the elements within the tolerance: n·up = 0 for those across, n×up = 0 for those along.
Eigen::Vector3d refine(const std::vector<SurfaceElement>& surface, Eigen::Vector3d up, double tolerance_sine) {
  const double along_cosine = std::sqrt(1.0 - tolerance_sine * tolerance_sine);
  Eigen::Matrix3d cost = Eigen::Matrix3d::Zero();
  for (const SurfaceElement& element : surface) {
    const double cosine = std::fabs(element.normal_world.dot(up));
    const double sign = cosine > along_cosine ? -1.0 : cosine < tolerance_sine ? 1.0 : 0.0;
    cost += sign * element.normal_world * element.normal_world.transpose();
  }
  const Eigen::Vector3d least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cost).eigenvectors().col(0);
  const double cosine = least.dot(up);
  // Too little surface can make any direction the least: keep the start then.
  return std::fabs(cosine) > 0.9 ? Eigen::Vector3d(cosine > 0.0 ? least : -least) : up;
}

}  // namespace

UpDirection findUp(const std::vector<SurfaceElement>& surface, const UpPrior& prior) {
  UpDirection best{prior.image_up_world, 0.0};
  double best_score = 0.0;
  for (const Eigen::Vector3d& direction : listDirections(prior)) {
    const double direction_score = score(countVotes(surface, direction), direction.dot(prior.image_up_world));
    if (direction_score > best_score) {
      best_score = direction_score;
      best.up_world = direction;
    }
  }
  for (const double tolerance_sine : {kTolerance_sine, kTolerance_sine, 0.5 * kTolerance_sine, 0.5 * kTolerance_sine}) {
    best.up_world = refine(surface, best.up_world, tolerance_sine);
  }
  if (!surface.empty()) {
    const Votes votes = countVotes(surface, best.up_world);
    best.agreement = (votes.along + votes.across) / static_cast<double>(surface.size());
  }
  return best;
}

}  // namespace oikos::mapping
