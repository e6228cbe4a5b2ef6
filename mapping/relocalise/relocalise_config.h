// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/odometry/features.h"
#include "mapping/odometry/landmark_follower.h"
#include "mapping/odometry/relative_motion.h"

namespace oikos::mapping {

/// How a frame is found in a saved map. Features and pyramid are those that the map was made with.
struct RelocaliseConfig {
  FeatureConfig features;
  /// Laxer than the mapper's: what features propose, landmarks have to confirm.
  RelativeMotionConfig motion{.min_inliers = 12, .min_inlier_ratio = 0.2, .min_spread = 0.02};
  FollowerConfig follower;
  int pyramid_levels = 5;
  int candidates = 8;          ///< places verified per frame, the likeliest first
  int min_votes = 8;           ///< a place with fewer is not verified
  int local_keyframes = 6;     ///< keyframes that lend their landmarks: those with most in view
  int most_landmarks = 900;    ///< looked for in one frame
  double max_view_deg = 45.0;  ///< between the rays to a landmark from its keyframe and from here
  double map_sigma_m = 0.007;  ///< what the map's own poses are off by from one place to the next
  double map_sigma_deg = 0.2;  ///< and turned; both are added to the covariance

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("features", features);
    visitor("motion", motion);
    visitor("follower", follower);
    visitor("pyramid_levels", pyramid_levels);
    visitor("candidates", candidates);
    visitor("min_votes", min_votes);
    visitor("local_keyframes", local_keyframes);
    visitor("most_landmarks", most_landmarks);
    visitor("max_view_deg", max_view_deg);
    visitor("map_sigma_m", map_sigma_m);
    visitor("map_sigma_deg", map_sigma_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::mapping
