// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/ceiling_camera.h"

#include <algorithm>
#include <cmath>

#include "core/base/config_rules.h"
#include "core/camera/sensor/color_sensor.h"
#include "core/model/primitives.h"

namespace oikos::simulate {

namespace {

Eigen::Vector3d toVector(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

camera::Calibration calibrationOf(const CeilingSettings& settings) {
  camera::Calibration calibration;
  calibration.color = {settings.width, settings.height, settings.fx, settings.fy, settings.cx, settings.cy};
  const std::vector<double>& d = settings.distortion;
  calibration.distortion = {d[0], d[1], d[2], d[3], d[4]};
  return calibration;
}

/// Flat on the robot, its y ahead.
Eigen::Isometry3d boardMount(const CeilingSettings& settings) {
  Eigen::Isometry3d T_base_board = Eigen::Isometry3d::Identity();
  T_base_board.linear() << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  T_base_board.translation() = toVector(settings.board_m);
  return T_base_board;
}

/// Whoever hangs up the camera sets it so that the white of the board is not cut off: where it is, black squares look smaller.
camera::AutoExposureConfig darkExposure() {
  camera::AutoExposureConfig config;
  config.target_light = 0.06;
  return config;
}

/// The picture, matt, on a plate of 1 cm.
model::TriangleMesh makeBoard(const tags::TagBoard& board) {
  constexpr int kPixelsPerCell = 16;
  constexpr double kThickness_m = 0.01;
  const auto half_x = static_cast<float>(0.5 * board.width_m());
  const auto half_y = static_cast<float>(0.5 * board.height_m());
  model::TriangleMesh picture;
  picture.vertices = {{-half_x, -half_y, 0.0F}, {half_x, -half_y, 0.0F}, {half_x, half_y, 0.0F}, {-half_x, half_y, 0.0F}};
  picture.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
  picture.triangles = {{0, 1, 2}, {0, 2, 3}};
  picture.materials.resize(1);
  picture.materials.front().color_rgb.setConstant(0.75F);
  picture.materials.front().texture = drawTagBoard(board, kPixelsPerCell);
  const model::TriangleMesh plate = model::makeBox({2.0F * half_x, 2.0F * half_y, static_cast<float>(kThickness_m)});
  append(picture, plate, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.5 * kThickness_m - 0.001)));
  return picture;
}

}  // namespace

std::vector<std::string> CeilingSettings::validate() const {
  base::ConfigRules rules;
  const auto requireCount = [&](const char* key, const std::vector<double>& numbers, std::size_t count, const char* rule) {
    const bool all_finite = std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    rules.require(numbers.size() == count && all_finite, key, static_cast<double>(numbers.size()), rule);
  };
  if (!position_m.empty()) {
    requireCount("position_m", position_m, 3, "must be three numbers: x, y, z (m) in map; or none");
    requireCount("look_at_m", look_at_m, 3, "must be three numbers: x, y, z (m) in map");
    rules.require(position_m != look_at_m, "look_at_m", static_cast<double>(look_at_m.size()), "must be another place than position_m");
  }
  requireCount("board_m", board_m, 3, "must be three numbers: x, y, z (m) in base");
  requireCount("distortion", distortion, 5, "must be five numbers: k1, k2, p1, p2, k3");
  rules.between("width", width, 16, 4096).between("height", height, 16, 4096);
  rules.greater("fx", fx, 0.0).greater("fy", fy, 0.0).between("cx", cx, 0.0, width).between("cy", cy, 0.0, height);
  rules.between("jpeg_quality", jpeg_quality, 0, 100);
  return rules.messages();
}

CeilingCamera::CeilingCamera(const CeilingSettings& settings, const render::Lighting& lighting, render::Scene& scene)
    : calibration_(calibrationOf(settings)),
      lighting_(lighting),
      rays_(calibration_.color, calibration_.distortion),
      exposure_(darkExposure(), camera::Exposure{0.004, 1.0}) {
  setup_.T_map_camera = tags::numbersOf(lookAt(toVector(settings.position_m), toVector(settings.look_at_m)));
  setup_.T_base_board = tags::numbersOf(boardMount(settings));
  setup_.board = settings.board;
  board_model_ = scene.add(std::make_shared<const model::TriangleMesh>(makeBoard(settings.board)), Eigen::Isometry3d::Identity());
  scene.show(board_model_, false);
}

cv::Mat CeilingCamera::shoot(render::Scene& scene, const Eigen::Isometry3d& T_map_base, const camera::SensorRun& run) {
  scene.move(board_model_, T_map_base * tags::poseOf(setup_.T_base_board), {});
  scene.show(board_model_, true);
  scene.commit();
  render::ViewConfig config;
  config.with_color = true;
  config.lighting = lighting_;
  config.threads = run.threads;
  const render::View view = renderView(scene, rays_, {tags::poseOf(setup_.T_map_camera), {}}, config);
  scene.show(board_model_, false);
  scene.commit();
  camera::ColorShot shot;
  shot.exposure = exposure_.current();
  cv::Mat color = senseColor({calibration_.color, view.color, view.depth_m}, shot, camera::ColorSensorConfig{}, run);
  exposure_.observe(camera::measureMeanLight(color));
  return color;
}

Eigen::Isometry3d lookAt(const Eigen::Vector3d& position_map, const Eigen::Vector3d& look_at_map) {
  constexpr double kStraight = 1e-6;
  const Eigen::Vector3d z = (look_at_map - position_map).normalized();
  Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ());
  x = x.norm() < kStraight ? Eigen::Vector3d::UnitX() : x.normalized();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear().col(0) = x;
  T_map_camera.linear().col(1) = z.cross(x);
  T_map_camera.linear().col(2) = z;
  T_map_camera.translation() = position_map;
  return T_map_camera;
}

}  // namespace oikos::simulate
