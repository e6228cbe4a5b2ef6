// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/camera/calibration.h"
#include "core/camera/sensor/auto_exposure.h"
#include "core/camera/sensor/ideal_view.h"
#include "core/render/camera_rays.h"
#include "core/render/scene.h"
#include "core/render/view.h"
#include "core/tags/tag_setup.h"
#include "tools/simulate/ceiling_settings.h"

namespace oikos::simulate {

/// Takes pictures of the robot's board of tags. The board is part of the scene while a picture is taken, and at no other time. The camera
/// hangs still; its pictures have noise, vignetting and exposure, but the board is as sharp as if it stood. Not thread-safe.
class CeilingCamera {
 public:
  /// Adds the board to the scene. `settings` has a position.
  CeilingCamera(const CeilingSettings& settings, const render::Lighting& lighting, render::Scene& scene);

  /// CV_8UC3. `run` chooses the noise.
  [[nodiscard]] cv::Mat shoot(render::Scene& scene, const Eigen::Isometry3d& T_map_base, const camera::SensorRun& run);

  [[nodiscard]] const camera::Calibration& calibration() const { return calibration_; }
  [[nodiscard]] const tags::TagSetup& setup() const { return setup_; }

 private:
  camera::Calibration calibration_;
  tags::TagSetup setup_;
  render::Lighting lighting_;
  render::CameraRays rays_;
  camera::AutoExposure exposure_;
  int board_model_ = 0;  ///< in the scene
};

/// From `position_map` towards `look_at_map`, x level; straight up or down: x along map's.
[[nodiscard]] Eigen::Isometry3d lookAt(const Eigen::Vector3d& position_map, const Eigen::Vector3d& look_at_map);

}  // namespace oikos::simulate
