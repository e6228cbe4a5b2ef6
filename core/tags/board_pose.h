// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "core/camera/calibration.h"
#include "core/tags/tag_board.h"
#include "core/tags/tag_detector.h"

namespace oikos::tags {

/// The camera that looks at the board.
struct BoardCamera {
  camera::PinholeCamera pinhole;
  camera::LensDistortion distortion;
};

struct BoardPose {
  Eigen::Isometry3d T_camera_board = Eigen::Isometry3d::Identity();
  int corners = 0;
  double rms_px = 0.0;  ///< distance of the corners to where the pose has them
};

/// Pose by all corners of the board's tags at once: Collins and Bartoli, "Infinitesimal Plane-Based Pose Estimation" (IJCV 2014,
/// doi:10.1007/s11263-014-0725-5), the better of its two solutions refined by Levenberg-Marquardt (OpenCV). Tags that are not the board's
/// are ignored. Nothing: none is the board's, or the board would lie behind the camera.
[[nodiscard]] std::optional<BoardPose> estimateBoardPose(const TagBoard& board, const std::vector<TagDetection>& detections,
                                                         const BoardCamera& camera);

}  // namespace oikos::tags
