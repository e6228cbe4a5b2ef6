// SPDX-License-Identifier: Apache-2.0
// The rules of this folder's configurations in one place.
#include "core/base/config_rules.h"
#include "mapping/odometry/corner_detector.h"
#include "mapping/odometry/features.h"
#include "mapping/odometry/landmark_follower.h"
#include "mapping/odometry/patch_aligner.h"
#include "mapping/odometry/pose_solver.h"
#include "mapping/odometry/relative_motion.h"

namespace oikos::mapping {

namespace {

constexpr int kCoarsestLevel = 10;  ///< of any pyramid
constexpr int kLeastSightings = 6;  ///< that the pose solver takes

}  // namespace

std::vector<std::string> PatchAlignerConfig::validate() const {
  return base::ConfigRules()
      .atLeast("max_iterations", max_iterations, 1)
      .greater("converged_px", converged_px, 0.0)
      .greater("max_step_px", max_step_px, 0.0)
      .between("min_correlation", min_correlation, 0.0, 1.0)
      .between("coarsest_answer", coarsest_answer, 0, kCoarsestLevel)
      .atLeast("min_eigenvalue", min_eigenvalue, 0.0)
      .messages();
}

std::vector<std::string> PoseSolverConfig::validate() const {
  return base::ConfigRules()
      .atLeast("max_iterations", max_iterations, 1)
      .greater("huber_sigmas", huber_sigmas, 0.0)
      .greater("outlier_sigmas", outlier_sigmas, 0.0)
      .atLeast("depth_weight", depth_weight, 0.0)
      .greater("converged", converged, 0.0)
      .messages();
}

std::vector<std::string> FollowerConfig::validate() const {
  return base::ConfigRules()
      .greater("pixel_sigma_px", pixel_sigma_px, 0.0)
      .greater("max_scale", max_scale, 1.0)
      .atLeast("border_px", border_px, 0.0)
      .between("coarsest_level", coarsest_level, 0, kCoarsestLevel)
      .atLeast("min_inliers", min_inliers, kLeastSightings)
      .between("min_inlier_ratio", min_inlier_ratio, 0.0, 1.0)
      .messages();
}

std::vector<std::string> CornerDetectorConfig::validate() const {
  return base::ConfigRules()
      .between("cell_px", cell_px, 1, 1000)
      .greater("min_response", min_response, 0.0)
      .atLeast("enough", enough, 0)
      .greater("min_weak_response", min_weak_response, 0.0)
      .greater("max_depth_m", max_depth_m, 0.0)
      .between("depth_window_px", depth_window_px, 1, 50)
      .greater("max_plane_residual", max_plane_residual, 0.0)
      .messages();
}

std::vector<std::string> FeatureConfig::validate() const {
  base::ConfigRules rules;
  rules.between("count", count, 1, 100000);
  rules.require(image_scale > 0.0 && image_scale <= 1.0, "image_scale", image_scale, "must be > 0 and <= 1");
  rules.greater("contrast_threshold", contrast_threshold, 0.0)
      .between("fast_threshold", fast_threshold, 1, 255)
      .greater("max_depth_m", max_depth_m, 0.0);
  return rules.messages();
}

std::vector<std::string> RelativeMotionConfig::validate() const {
  return base::ConfigRules()
      .atLeast("max_hypotheses", max_hypotheses, 1)
      .greater("inlier_px", inlier_px, 0.0)
      .greater("inlier_depth_sigmas", inlier_depth_sigmas, 0.0)
      .atLeast("min_inliers", min_inliers, kLeastSightings)
      .between("min_inlier_ratio", min_inlier_ratio, 0.0, 1.0)
      .between("min_spread", min_spread, 0.0, 1.0)
      .messages();
}

}  // namespace oikos::mapping
