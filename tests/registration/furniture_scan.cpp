// SPDX-License-Identifier: Apache-2.0
#include "tests/registration/furniture_scan.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/number_text.h"
#include "core/model/primitives.h"
#include "core/render/view.h"
#include "tests/support/analytic_room.h"

namespace oikos::test {

namespace {

std::shared_ptr<const model::TriangleMesh> box(float x, float y, float z, const Eigen::Vector3f& color_rgb) {
  model::TriangleMesh mesh = model::makeBox({x, y, z});
  mesh.materials.assign(1, {});
  mesh.materials[0].color_rgb = color_rgb;
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  return std::make_shared<const model::TriangleMesh>(std::move(mesh));
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// How far the piece reaches back (−x in its frame).
double backOf(const model::ArticulatedModel& model, const std::vector<double>& joint_values) {
  const auto T_model_part = model::Kinematics(model).solve(joint_values);
  double back_m = 0.0;
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    if (model.parts[part].mesh_part) {
      for (const Eigen::Vector3f& vertex : model.parts[part].mesh_part->vertices) {
        back_m = std::min(back_m, (T_model_part[part] * vertex.cast<double>()).x());
      }
    }
  }
  return back_m;
}

}  // namespace

camera::PinholeCamera kinectCamera() {
  return {640, 480, 525.0, 525.0, 319.5, 239.5};
}

const std::vector<FurnitureKind>& furnitureKinds() {
  static const std::vector<FurnitureKind> kinds = {
      {"cabinet"}, {"drawer_unit"}, {"fridge"}, {"oven"},  {"dishwasher"},
      {"table"},   {"sofa"},        {"bed"},    {"shelf"}, {"cabinet", {{"door_count", "2"}, {"width_m", "0.9"}, {"height_m", "1.9"}}}};
  return kinds;
}

model::ArticulatedModel trulyBuilt(const FurnitureKind& furniture, double dimension_sigma_m, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  model::Dimensions dimensions = model::shapeDimensions(furniture.kind);
  for (auto& [name, value] : dimensions) {
    for (const auto& [changed, to] : furniture.dimensions) {
      value = name == changed ? to : value;
    }
    const bool measured =
        name == "width_m" || name == "depth_m" || name == "height_m" || name == "plinth_height_m" || name == "seat_height_m";
    if (measured) {
      const double length_m = std::stod(value);
      const double error_m = std::clamp(dimension_sigma_m * normal(random), -0.1 * length_m, 0.1 * length_m);
      value = base::toText(length_m + error_m);
    }
  }
  return model::makeShape(furniture.kind, dimensions, furniture.kind);
}

model::ArticulatedModel believed(const FurnitureKind& furniture) {
  return model::makeShape(furniture.kind, furniture.dimensions, furniture.kind);
}

render::View viewOf(const render::Scene& scene, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) {
  render::ViewConfig config;
  config.with_normals = true;
  config.with_parts = true;
  config.with_surface = true;
  return render::renderView(scene, render::CameraRays(camera), {T_map_camera, {}}, config);
}

cv::Mat sensed(const render::View& view, const camera::PinholeCamera& camera, camera::DepthSensorKind kind, std::uint64_t seed) {
  camera::IdealView ideal;
  ideal.depth_m = view.depth_m;
  ideal.normal_camera = view.normal_camera;
  ideal.gloss = view.gloss;
  ideal.reflectivity = view.albedo;
  camera::DepthSensorConfig sensor;
  sensor.kind = kind;
  const cv::Mat units = camera::senseDepth(ideal, camera, sensor, {.seed = seed});
  cv::Mat depth_m;
  units.convertTo(depth_m, CV_32FC1, 1.0 / sensor.units_per_m);
  depth_m.setTo(std::numeric_limits<float>::quiet_NaN(), units == 0);
  return depth_m;
}

cv::Mat recordDepth(const FurnitureScene& scene, const camera::PinholeCamera& camera) {
  render::Scene world;
  world.add(*scene.model, scene.T_map_model, scene.joint_values);
  world.add(box(12.0F, 12.0F, 0.1F, {0.5F, 0.4F, 0.3F}), at(0.0, 0.0, -0.05));
  if (scene.has_wall) {
    world.add(box(0.1F, 12.0F, 3.0F, {0.8F, 0.8F, 0.75F}),
              scene.T_map_model * at(backOf(*scene.model, scene.joint_values) - 0.06, 0.0, 1.5));
  }
  if (scene.has_occluder) {
    const Eigen::Vector3d between = 0.55 * scene.T_map_model.translation() + 0.45 * scene.T_map_camera.translation();
    world.add(box(0.3F, 0.4F, 1.7F, {0.3F, 0.3F, 0.6F}), at(between.x(), between.y(), 0.85));
  }
  world.commit();
  return sensed(viewOf(world, camera, scene.T_map_camera), camera, scene.sensor, scene.noise_seed);
}

Eigen::Isometry3d cameraBefore(const Eigen::Isometry3d& T_map_model, double distance_m, double off_axis_rad, double target_height_m) {
  const Eigen::Vector3d target = T_map_model * Eigen::Vector3d(0.0, 0.0, target_height_m);
  const Eigen::Vector3d out = T_map_model.linear() * Eigen::Vector3d(std::cos(off_axis_rad), std::sin(off_axis_rad), 0.0);
  Eigen::Vector3d eye = target + distance_m * out;
  eye.z() = 1.3;
  return lookAt(eye, target);
}

}  // namespace oikos::test
