// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/map_tracker.h"

#include "mapping/odometry/rotation_alignment.h"

namespace oikos::mapping {

LocateResult MapTracker::add(const camera::RgbdFrame& frame, const std::optional<Eigen::Isometry3d>& T_map_camera_prior) {
  const auto pyramid = std::make_shared<const ImagePyramid>(frame.gray, relocaliser_.config().pyramid_levels);
  const LocatedFrame located{frame, *pyramid};
  LocateResult result;
  if (previous_) {
    result = relocaliser_.findNear(located, predict(*pyramid));
  }
  const bool was_followed = result.found();
  if (!result.found() && T_map_camera_prior) {
    result = relocaliser_.findNear(located, *T_map_camera_prior);
  }
  if (!result.found()) {
    result = relocaliser_.find(located);
  }
  T_previous_current_ = was_followed ? T_map_camera_.inverse() * result.T_map_camera : Eigen::Isometry3d::Identity();
  previous_ = result.found() ? pyramid : nullptr;
  T_map_camera_ = result.T_map_camera;
  return result;
}

/// The last motion once more, its turn corrected by the images.
Eigen::Isometry3d MapTracker::predict(const ImagePyramid& pyramid) const {
  Eigen::Isometry3d T_previous_current = T_previous_current_;
  const RotationAlignment turn = alignRotation(*previous_, pyramid, relocaliser_.map().camera(), T_previous_current_.linear());
  if (turn.converged) {
    T_previous_current.linear() = turn.R_previous_current;
  }
  return T_map_camera_ * T_previous_current;
}

}  // namespace oikos::mapping
