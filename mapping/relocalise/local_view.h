// SPDX-License-Identifier: Apache-2.0
// What of a saved map a camera sees from somewhere.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/rgbd_frame.h"
#include "mapping/odometry/image_pyramid.h"
#include "mapping/odometry/landmark_follower.h"
#include "mapping/relocalise/relocalise_config.h"
#include "mapping/relocalise/saved_map.h"

namespace oikos::mapping {

/// Landmarks of the keyframes that share most with a camera there, in order. A landmark counts if it is in the image, seen from a like
/// direction, and not behind what the depth image shows there.
[[nodiscard]] std::vector<int> landmarksInView(const SavedMap& map, const Eigen::Isometry3d& T_map_camera, const cv::Mat& depth_m,
                                               const RelocaliseConfig& config);

/// A frame with its pyramid.
struct LocatedFrame {
  const camera::RgbdFrame& frame;
  const ImagePyramid& pyramid;
};

/// Follows landmarks of the map in a frame from a pose near the true one.
[[nodiscard]] FollowResult followInMap(const SavedMap& map, const LocatedFrame& located, const std::vector<int>& landmarks,
                                       const Eigen::Isometry3d& T_map_camera, const RelocaliseConfig& config);

}  // namespace oikos::mapping
