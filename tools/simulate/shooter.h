// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/camera/calibration.h"
#include "core/camera/sensor/auto_exposure.h"
#include "core/camera/sensor/color_sensor.h"
#include "core/camera/sensor/depth_sensor.h"
#include "core/render/view.h"
#include "tools/simulate/robot_path.h"

namespace oikos::simulate {

struct ShotSettings {
  camera::Calibration calibration;  ///< the true one
  camera::DepthSensorConfig depth;
  camera::ColorSensorConfig color;
  render::Lighting lighting;
  double readout_s = 0.0;
  double depth_delay_s = 0.0;
  std::uint64_t seed = 0;
  int threads = 1;
};

struct Shot {
  cv::Mat color;                                                   ///< CV_8UC3, as the sensor gives it
  cv::Mat depth;                                                   ///< CV_16UC1
  cv::Mat part;                                                    ///< CV_32SC1, of the colour picture, as render::View
  cv::Mat depth_m;                                                 ///< CV_32FC1, of the colour picture, exact
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();  ///< in the middle of the colour picture's read-out
};

/// Takes one picture after another; the exposure follows their brightness. Not thread-safe.
class Shooter {
 public:
  explicit Shooter(const ShotSettings& settings);

  /// `frame`: its number, which chooses its noise.
  [[nodiscard]] Shot shoot(const render::Scene& scene, const RobotPath& path, double time_s, std::int64_t frame);

 private:
  [[nodiscard]] Eigen::Isometry3d cameraAt(const RobotPath& path, double time_s) const;
  [[nodiscard]] cv::Mat shootDepth(const render::Scene& scene, const RobotPath& path, double time_s, const camera::SensorRun& run) const;
  [[nodiscard]] cv::Mat develop(const render::View& view, const RobotPath& path, double time_s, const camera::SensorRun& run);

  ShotSettings settings_;
  render::CameraRays color_rays_;
  camera::PinholeCamera depth_camera_;
  render::CameraRays depth_rays_;
  camera::AutoExposure exposure_;
};

}  // namespace oikos::simulate
