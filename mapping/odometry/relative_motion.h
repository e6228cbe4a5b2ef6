// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"
#include "mapping/odometry/features.h"
#include "mapping/odometry/pose_solver.h"

namespace oikos::mapping {

struct RelativeMotionConfig {
  int max_hypotheses = 400;
  double inlier_px = 3.0;            ///< reprojection error of an inlier, at 640 pixels' width
  double inlier_depth_sigmas = 4.0;  ///< and its depth error, in the deviations of both readings
  int min_inliers = 20;
  double min_inlier_ratio = 0.3;  ///< inliers / matches
  double min_spread = 0.04;       ///< area of the inliers' 2-sigma ellipse in the image / the image's area

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_hypotheses", max_hypotheses);
    visitor("inlier_px", inlier_px);
    visitor("inlier_depth_sigmas", inlier_depth_sigmas);
    visitor("min_inliers", min_inliers);
    visitor("min_inlier_ratio", min_inlier_ratio);
    visitor("min_spread", min_spread);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class MotionStatus { kTooFewMatches, kTooFewInliers, kTooLittleSpread, kConverged };

struct [[nodiscard]] RelativeMotion {
  MotionStatus status = MotionStatus::kTooFewMatches;
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation of T_a_b
  std::vector<int> inlier;                                     ///< positions in the matches
  double rms_px = 0.0;
  double spread = 0.0;
};

/// Motion between two images from matched features with depth: RANSAC over closed-form alignment of three pairs (S40: Arun et al.,
/// PAMI 1987; Umeyama, PAMI 1991), then refined on the inliers by reprojection and depth weighted by their noise.
RelativeMotion estimateMotion(const Features& a, const Features& b, const std::vector<FeatureMatch>& matches,
                              const camera::PinholeCamera& camera, const RelativeMotionConfig& config, std::uint64_t seed);

}  // namespace oikos::mapping
