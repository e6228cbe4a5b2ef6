// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/training/panel_shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/camera/sensor/color_sensor.h"
#include "core/render/view.h"

namespace oikos::recognition {

namespace {

/// The lens of a Kinect where that brings the camera no nearer than a robot's would be, else a longer one.
double focalLength_px(double distance_at_one_px_m, double wanted_m) {
  double focal_px = 525.0;
  while (focal_px * distance_at_one_px_m < wanted_m && focal_px < 1500.0) {
    focal_px += 265.0;
  }
  return focal_px;
}

Eigen::Isometry3d cameraAt(const ShotOrder& order, double distance_m) {
  const double across = std::sin(order.tilt_rad);
  const Eigen::Vector3d away(across * std::cos(order.azimuth_rad), across * std::sin(order.azimuth_rad), std::cos(order.tilt_rad));
  const Eigen::Vector3d target(order.target_panel.x(), order.target_panel.y(), 0.0);
  Eigen::Matrix3d R_panel_camera;
  const Eigen::Vector3d forward = -away;
  const Eigen::Vector3d hint = std::abs(forward.y()) < 0.95 ? Eigen::Vector3d(0.0, -1.0, 0.0) : Eigen::Vector3d(0.0, 0.0, 1.0);
  const Eigen::Vector3d right = hint.cross(forward).normalized();
  R_panel_camera << right, forward.cross(right), forward;
  Eigen::Isometry3d T_panel_camera = Eigen::Isometry3d::Identity();
  T_panel_camera.linear() = R_panel_camera * Eigen::AngleAxisd(order.roll_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_panel_camera.translation() = target + distance_m * away;
  return T_panel_camera;
}

void blurByMotion(cv::Mat& color, double length_px, double direction_rad) {
  constexpr int kSize = 9;
  constexpr int kSteps = 33;
  cv::Mat kernel = cv::Mat::zeros(kSize, kSize, CV_32FC1);
  for (int i = 0; i < kSteps; ++i) {
    const double along = length_px * (static_cast<double>(i) / (kSteps - 1) - 0.5);
    const double x = kSize / 2 + along * std::cos(direction_rad);
    const double y = kSize / 2 + along * std::sin(direction_rad);
    const int u = std::clamp(static_cast<int>(x), 0, kSize - 2);
    const int v = std::clamp(static_cast<int>(y), 0, kSize - 2);
    const double a = x - u;
    const double b = y - v;
    kernel.at<float>(v, u) += static_cast<float>((1.0 - a) * (1.0 - b) / kSteps);
    kernel.at<float>(v, u + 1) += static_cast<float>(a * (1.0 - b) / kSteps);
    kernel.at<float>(v + 1, u) += static_cast<float>((1.0 - a) * b / kSteps);
    kernel.at<float>(v + 1, u + 1) += static_cast<float>(a * b / kSteps);
  }
  cv::filter2D(color, color, -1, kernel);
}

}  // namespace

PanelShot shootPanel(const Panel& panel, const ShotOrder& order, Random& random) {
  PanelShot shot;
  const double per_px_m = 2.0 * order.radius_m / order.diameter_px;
  const double focal_px = focalLength_px(per_px_m, 0.5);
  const double distance_m = focal_px * per_px_m;
  shot.camera = {order.width_px,
                 order.height_px,
                 focal_px,
                 focal_px,
                 order.width_px / 2.0 + random.between(-order.offset_px, order.offset_px),
                 order.height_px / 2.0 + random.between(-order.offset_px, order.offset_px)};
  const Eigen::Isometry3d T_panel_camera = cameraAt(order, distance_m);
  shot.T_camera_panel = T_panel_camera.inverse();
  render::ViewConfig config;
  config.with_color = true;
  config.lighting = panel.lighting;
  const render::View view =
      render::renderView(*panel.scene, render::CameraRays(shot.camera), {panel.T_map_panel * T_panel_camera, {}}, config);
  cv::Mat color = view.color;
  cv::GaussianBlur(color, color, cv::Size(0, 0), random.between(0.3, order.max_defocus_px));
  blurByMotion(color, random.between(0.0, std::min(order.max_motion_px, order.diameter_px / 8.0)), random.between(0.0, std::numbers::pi));
  const camera::Exposure reference;
  const double gain = random.between(1.0, 5.0);
  const std::uint64_t noise = random.bits();
  shot.color = camera::senseColor({shot.camera, color, {}}, {{reference.time_s / gain, gain}, {}}, {}, {noise, 0, 1});
  return shot;
}

}  // namespace oikos::recognition
