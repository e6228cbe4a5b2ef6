// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/camera/pinhole_camera.h"
#include "recognition/knobs/training/panel.h"

namespace oikos::recognition {

/// From where a picture is taken, and how badly.
struct ShotOrder {
  Eigen::Vector2d target_panel = Eigen::Vector2d::Zero();  ///< what the camera looks at, about
  double radius_m = 0.02;                                  ///< of a knob there
  double diameter_px = 60.0;                               ///< its longer axis in the picture, about
  double tilt_rad = 0.0;                                   ///< between the ray to the target and the panel's normal
  double azimuth_rad = 0.0;                                ///< towards which side of the panel the camera stands
  double roll_rad = 0.0;
  int width_px = 160;
  int height_px = 160;
  double offset_px = 0.0;       ///< how far the target may be from the middle, each way
  double max_defocus_px = 1.2;  ///< deviation of the blur of the lens
  double max_motion_px = 3.0;   ///< length of the blur by motion, at most an eighth of the diameter
};

struct PanelShot {
  cv::Mat color;  ///< CV_8UC3, BGR
  camera::PinholeCamera camera;
  Eigen::Isometry3d T_camera_panel = Eigen::Isometry3d::Identity();
};

/// A picture with blur and noise. Thread-safe.
[[nodiscard]] PanelShot shootPanel(const Panel& panel, const ShotOrder& order, Random& random);

}  // namespace oikos::recognition
