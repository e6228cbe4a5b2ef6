// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/camera/rgbd_frame.h"
#include "mapping/odometry/image_pyramid.h"
#include "mapping/relocalise/relocaliser.h"

namespace oikos::mapping {

/// Follows a camera through a saved map, frame by frame: from its last pose and motion, by Relocaliser::find when it is lost. Nothing is
/// added to the map. Not thread-safe.
class MapTracker {
 public:
  /// `relocaliser` outlives the tracker.
  explicit MapTracker(const Relocaliser& relocaliser) : relocaliser_(relocaliser) {}

  /// `T_map_camera_prior`: where someone else believes the frame to be; tried where tracking has nothing to go by.
  LocateResult add(const camera::RgbdFrame& frame, const std::optional<Eigen::Isometry3d>& T_map_camera_prior = {});

 private:
  [[nodiscard]] Eigen::Isometry3d predict(const ImagePyramid& pyramid) const;

  const Relocaliser& relocaliser_;
  std::shared_ptr<const ImagePyramid> previous_;  ///< null: lost
  Eigen::Isometry3d T_map_camera_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_previous_current_ = Eigen::Isometry3d::Identity();  ///< the expected motion
};

}  // namespace oikos::mapping
