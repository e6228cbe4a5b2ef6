// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/tags/board_pose.h"

namespace oikos::tags {

/// What a camera sees of a board before a grey wall: the mean of 6x6 exact rays a pixel. CV_8UC1.
[[nodiscard]] cv::Mat takeBoardPicture(const TagBoard& board, const BoardCamera& camera, const Eigen::Isometry3d& T_camera_board);

/// A board that faces the camera, upright, turned by `tilt_rad` about its x and then by `roll_rad` about the optical axis.
struct FacingBoard {
  Eigen::Vector3d position_camera = Eigen::Vector3d(0.0, 0.0, 2.0);
  double tilt_rad = 0.0;
  double roll_rad = 0.0;
};
[[nodiscard]] Eigen::Isometry3d placeBoard(const FacingBoard& board);

/// 640x480 pixels, 525 of focal length.
[[nodiscard]] BoardCamera plainCamera();

}  // namespace oikos::tags
