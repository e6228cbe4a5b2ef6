// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/shooter.h"

#include "core/geometry/se3.h"

namespace oikos::simulate {

namespace {

/// Depth that is registered to colour has the colour lens.
camera::LensDistortion depthLens(const camera::Calibration& calibration) {
  return calibration.depth ? camera::LensDistortion{} : calibration.distortion;
}

}  // namespace

Shooter::Shooter(const ShotSettings& settings)
    : settings_(settings),
      color_rays_(settings.calibration.color, settings.calibration.distortion),
      depth_camera_(settings.calibration.depth ? settings.calibration.depth->pinhole : settings.calibration.color),
      depth_rays_(depth_camera_, depthLens(settings.calibration)),
      exposure_(camera::AutoExposureConfig{}, camera::Exposure{}) {}

Shot Shooter::shoot(const render::Scene& scene, const RobotPath& path, double time_s, std::int64_t frame) {
  const camera::SensorRun run{settings_.seed, frame, settings_.threads};
  render::ViewConfig config;
  config.with_color = true;
  config.with_parts = true;
  config.lighting = settings_.lighting;
  config.threads = settings_.threads;
  render::Viewpoint viewpoint{cameraAt(path, time_s - 0.5 * settings_.readout_s), {}};
  if (settings_.readout_s > 0.0) {
    viewpoint.T_map_camera_last_row = cameraAt(path, time_s + 0.5 * settings_.readout_s);
  }
  const render::View view = renderView(scene, color_rays_, viewpoint, config);
  Shot shot;
  shot.T_map_camera = cameraAt(path, time_s);
  shot.part = view.part;
  shot.depth_m = view.depth_m;
  shot.color = settings_.depth.kind == camera::DepthSensorKind::kIdeal ? view.color : develop(view, path, time_s, run);
  shot.depth = shootDepth(scene, path, time_s + settings_.depth_delay_s, run);
  return shot;
}

Eigen::Isometry3d Shooter::cameraAt(const RobotPath& path, double time_s) const {
  return path.at(time_s).T_map_base() * *settings_.calibration.T_base_camera;
}

cv::Mat Shooter::shootDepth(const render::Scene& scene, const RobotPath& path, double time_s, const camera::SensorRun& run) const {
  render::ViewConfig config;
  config.with_normals = true;
  config.with_surface = true;
  config.threads = settings_.threads;
  render::Viewpoint viewpoint{cameraAt(path, time_s), {}};
  if (settings_.calibration.depth) {
    viewpoint.T_map_camera = viewpoint.T_map_camera * settings_.calibration.depth->T_color_depth;
  }
  const render::View view = renderView(scene, depth_rays_, viewpoint, config);
  return senseDepth({view.depth_m, view.normal_camera, view.albedo, view.gloss}, depth_camera_, settings_.depth, run);
}

/// What the sensor makes of the light: exposure, vignetting, noise, and the blur of its motion (the renderer has read the rows one by one).
cv::Mat Shooter::develop(const render::View& view, const RobotPath& path, double time_s, const camera::SensorRun& run) {
  constexpr double kStep_s = 1e-3;
  camera::ColorShot shot;
  shot.exposure = exposure_.current();
  const Eigen::Isometry3d T_before_after = cameraAt(path, time_s - kStep_s).inverse() * cameraAt(path, time_s + kStep_s);
  shot.motion.twist_camera = geometry::logSe3(T_before_after) / (2.0 * kStep_s);
  cv::Mat color = senseColor({settings_.calibration.color, view.color, view.depth_m}, shot, settings_.color, run);
  exposure_.observe(camera::measureMeanLight(color));
  return color;
}

}  // namespace oikos::simulate
