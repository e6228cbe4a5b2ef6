// SPDX-License-Identifier: Apache-2.0
// A knob's face as it would look from straight above, cut out of a picture: its plane is known, so its tilt need not be learnt.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/camera/pinhole_camera.h"

namespace oikos::recognition {

/// From where the camera looks at a face. Frame `patch`: the face's, turned so that y points to where the camera stands; seen from the
/// camera y is down and the image reads as usual, with z into the carrier. Sides of the knob that can be seen are then always below.
struct FaceView {
  Eigen::Isometry3d T_camera_face = Eigen::Isometry3d::Identity();
  double tilt_rad = 0.0;     ///< between the face's normal and the ray to the camera
  double azimuth_rad = 0.0;  ///< of the camera about the face's z, from its x
  double px_per_m = 0.0;     ///< in the picture, across the tilt
};
[[nodiscard]] FaceView viewFace(const Eigen::Isometry3d& T_camera_face, const camera::PinholeCamera& camera);

/// Pixels on the face's plane: pixel (origin.x, origin.y) is `centre_patch` (m).
struct PatchGrid {
  cv::Size size;
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();
  double px_per_m = 1.0;
  Eigen::Vector2d centre_patch = Eigen::Vector2d::Zero();
};

/// The pixel of the picture that a point of the patch's plane falls on.
[[nodiscard]] Eigen::Vector2d projectPatch(const FaceView& view, const camera::PinholeCamera& camera, const Eigen::Vector2d& point_patch);

/// `image` resampled on the grid, smoothed before where that has fewer pixels than the picture; beyond the picture its border repeats.
/// Of the image's type with 32-bit floats; bytes become 0 to 1.
[[nodiscard]] cv::Mat samplePatch(const cv::Mat& image, const camera::PinholeCamera& camera, const FaceView& view, const PatchGrid& grid);

}  // namespace oikos::recognition
