// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/rig.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/base/number_text.h"
#include "core/base/rfc3339.h"
#include "core/camera/sensor/depth_sensor.h"
#include "tools/simulate/dice.h"

namespace oikos::simulate {

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Looks along the base's x, turned down by `tilt_rad`.
Eigen::Isometry3d mountOf(const CameraSettings& camera) {
  Eigen::Matrix3d R_level_camera;
  R_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // z forward, x right, y down
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(camera.tilt_deg * kRadPerDeg, Eigen::Vector3d::UnitY()) * R_level_camera;
  T.translation() = Eigen::Vector3d(camera.forward_m, 0.0, camera.height_m);
  return T;
}

/// Beside the colour camera, as published calibrations of the two sensors have it.
camera::DepthCamera depthCameraOf(const SceneScript& script) {
  camera::DepthCamera depth;
  if (script.sensor == camera::DepthSensorKind::kKinect1) {
    constexpr double kFocalRatio = 580.0 / 525.0;
    const CameraSettings& color = script.camera;
    depth.pinhole = {
        color.width, color.height, color.fx * kFocalRatio, color.fy * kFocalRatio, 0.5 * (color.width - 1), 0.5 * (color.height - 1)};
    depth.T_color_depth.translation() = Eigen::Vector3d(-0.025, 0.0, 0.0);
  } else {
    depth.pinhole = camera::nominalDepthCamera(script.sensor);
    depth.T_color_depth.translation() = Eigen::Vector3d(-0.052, 0.0, 0.0);
  }
  return depth;
}

void perturb(camera::PinholeCamera& pinhole, double share, Dice& dice) {
  const double focal = 1.0 + share * dice.gaussian();
  pinhole.fx *= focal;
  pinhole.fy *= focal;
  pinhole.cx += share * pinhole.width * dice.gaussian();
  pinhole.cy += share * pinhole.width * dice.gaussian();
}

std::string listOf(const std::vector<double>& numbers) {
  std::string text = "[";
  for (const double number : numbers) {
    text += (text.size() == 1 ? "" : ", ") + base::toText(number);
  }
  return text + "]";
}

std::string listOf(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return listOf({T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()});
}

void writePinhole(const camera::PinholeCamera& pinhole, std::ostream& toml) {
  toml << "width = " << pinhole.width << "\nheight = " << pinhole.height << "\nfx = " << base::toText(pinhole.fx)
       << "\nfy = " << base::toText(pinhole.fy) << "\ncx = " << base::toText(pinhole.cx) << "\ncy = " << base::toText(pinhole.cy) << '\n';
}

}  // namespace

camera::Calibration nominalCalibration(const SceneScript& script) {
  const CameraSettings& settings = script.camera;
  camera::Calibration calibration;
  calibration.color = {settings.width, settings.height, settings.fx, settings.fy, settings.cx, settings.cy};
  const std::vector<double>& d = settings.distortion;
  calibration.distortion = {d[0], d[1], d[2], d[3], d[4]};
  calibration.depth_scale = 1000.0;
  calibration.depth_distortion = 0.0;  // sensors are simulated without
  calibration.rate_hz = script.rate_hz;
  calibration.start_ns = base::parseRfc3339Ns(script.start);
  calibration.T_base_camera = mountOf(settings);
  if (script.sensor != camera::DepthSensorKind::kIdeal) {
    calibration.depth = depthCameraOf(script);
  }
  return calibration;
}

camera::Calibration trueCalibration(const camera::Calibration& nominal, const BeliefSettings& belief, std::uint64_t seed) {
  Dice dice(seed + 501);
  camera::Calibration calibration = nominal;
  perturb(calibration.color, belief.intrinsics_share, dice);
  if (calibration.depth) {
    perturb(calibration.depth->pinhole, belief.intrinsics_share, dice);
  }
  const Eigen::Vector3d axis = Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian()).normalized();
  const Eigen::Vector3d shift_m = belief.mount_m * Eigen::Vector3d(dice.gaussian(), dice.gaussian(), dice.gaussian());
  const double turn_rad = belief.mount_deg * kRadPerDeg * dice.gaussian();
  calibration.T_base_camera = *nominal.T_base_camera * Eigen::Translation3d(shift_m) * Eigen::AngleAxisd(turn_rad, axis);
  return calibration;
}

std::string toToml(const camera::Calibration& calibration, const std::string& start) {
  std::ostringstream toml;
  writePinhole(calibration.color, toml);
  const camera::LensDistortion& d = calibration.distortion;
  if (!d.isZero()) {
    toml << "distortion = " << listOf({d.k1, d.k2, d.p1, d.p2, d.k3}) << '\n';
  }
  toml << "depth_scale = " << base::toText(calibration.depth_scale) << "\ndepth_distortion = " << base::toText(calibration.depth_distortion)
       << "\nstart = \"" << start << "\"\nrate_hz = " << base::toText(calibration.rate_hz) << '\n';
  if (calibration.T_base_camera) {
    toml << "T_base_camera = " << listOf(*calibration.T_base_camera) << '\n';
  }
  if (calibration.depth) {
    toml << "\n[depth]\n";
    writePinhole(calibration.depth->pinhole, toml);
    toml << "T_color_depth = " << listOf(calibration.depth->T_color_depth) << '\n';
  }
  return toml.str();
}

}  // namespace oikos::simulate
