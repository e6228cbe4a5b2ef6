// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/odometry/image_pyramid.h"
#include "mapping/odometry/landmark.h"
#include "mapping/odometry/patch_aligner.h"
#include "mapping/odometry/pose_solver.h"

namespace oikos::mapping {

struct FollowerConfig {
  PatchAlignerConfig patch;
  PoseSolverConfig pose;
  double pixel_sigma_px = 0.5;     ///< of one aligned patch at level 0
  double max_scale = 2.5;          ///< a patch seen larger or smaller by more than this is left out
  double border_px = 8.0;          ///< predicted closer to the image's border: left out
  int coarsest_level = 3;          ///< of the first search; the second, from the solved pose, starts at level 1
  int min_inliers = 25;            ///< fewer: lost
  double min_inlier_ratio = 0.35;  ///< inliers / landmarks found; below it: lost

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("patch", patch);
    visitor("pose", pose);
    visitor("pixel_sigma_px", pixel_sigma_px);
    visitor("max_scale", max_scale);
    visitor("border_px", border_px);
    visitor("coarsest_level", coarsest_level);
    visitor("min_inliers", min_inliers);
    visitor("min_inlier_ratio", min_inlier_ratio);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// One image to look for landmarks in.
struct TargetView {
  const camera::PinholeCamera* camera = nullptr;
  const ImagePyramid* pyramid = nullptr;
  const cv::Mat* depth_m = nullptr;  ///< may be null: no depth residuals
};

/// A landmark with what is known of it: where its host was and the host's image.
struct Candidate {
  int landmark = -1;
  const Landmark* value = nullptr;
  Eigen::Isometry3d T_world_host = Eigen::Isometry3d::Identity();
  const ImagePyramid* host = nullptr;
};

struct [[nodiscard]] FollowResult {
  bool tracked = false;                   ///< enough inliers
  PoseSolution pose;                      ///< `inlier`: one a patch that was found
  std::vector<Observation> observations;  ///< inliers only, in the candidates' order
  int in_view = 0;                        ///< candidates that should have been seen
  int found = 0;                          ///< of these, patches that aligned
};

/// Looks for known landmarks in one image from a predicted pose, patch by patch, and solves for the pose; patches that disagree
/// or were not found are looked for once more from the solved pose.
FollowResult followLandmarks(const TargetView& view, const std::vector<Candidate>& candidates,
                             const Eigen::Isometry3d& T_world_camera_predicted, const FollowerConfig& config);

/// Looks for landmarks from a pose that is known to a few pixels, without solving for it: those whose patch is found within `gate_px`
/// of where it should be.
[[nodiscard]] std::vector<Observation> findLandmarks(const TargetView& view, const std::vector<Candidate>& candidates,
                                                     const Eigen::Isometry3d& T_world_camera, double gate_px, const FollowerConfig& config);

}  // namespace oikos::mapping
