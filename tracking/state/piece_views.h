// SPDX-License-Identifier: Apache-2.0
// Which pieces a frame sees, and how much of each.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "core/geometry/se3.h"
#include "tracking/localisation/localiser.h"
#include "tracking/state/articulated_pieces.h"
#include "tracking/state/state_config.h"

namespace oikos::tracking {

/// One piece in one frame.
struct PieceSight {
  int piece = 0;
  double worth = 0.0;  ///< for a registration: the more readings, and the more of its corners, the better
};

/// A located frame without its images.
struct SeenFrame {
  int frame = -1;  ///< of the recording
  std::int64_t stamp_ns = 0;
  PoseSource source = PoseSource::kNone;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  std::vector<PieceSight> sights;  ///< ascending
};

/// Counts the readings that lie where a piece and its open doors and drawers can be: what hides it is before it, and counts for nothing.
/// `pose`: of a frame that was found.
[[nodiscard]] SeenFrame lookFor(const std::vector<ArticulatedPiece>& pieces, const camera::RgbdFrame& frame,
                                const camera::PinholeCamera& camera, const LocatedPose& pose, const FrameChoiceConfig& config);

}  // namespace oikos::tracking
