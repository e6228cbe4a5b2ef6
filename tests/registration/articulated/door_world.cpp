// SPDX-License-Identifier: Apache-2.0
#include "tests/registration/articulated/door_world.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/model/primitives.h"

namespace oikos::registration {

void expectSame(const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b, double tolerance_m, double tolerance_rad) {
  EXPECT_LT((T_a.translation() - T_b.translation()).norm(), tolerance_m);
  EXPECT_LT(Eigen::AngleAxisd(T_a.linear().transpose() * T_b.linear()).angle(), tolerance_rad);
}

std::shared_ptr<const model::TriangleMesh> cuboid(const Eigen::AlignedBox3d& box_part) {
  model::TriangleMesh mesh = model::makeBox(Eigen::Vector3d(box_part.sizes()).cast<float>());
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex += Eigen::Vector3d(box_part.center()).cast<float>();
  }
  mesh.materials.assign(1, {});
  mesh.materials[0].color_rgb = {0.7F, 0.7F, 0.7F};
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  return std::make_shared<const model::TriangleMesh>(std::move(mesh));
}

DoorWorld::DoorWorld(model::ArticulatedModel built) : model(std::move(built)), values(model.joints.size(), 0.0) {
  lookFrom(1.6, 20.0);
}

void DoorWorld::lookFrom(double distance_m, double off_axis_deg) {
  T_map_camera = test::cameraBefore(T_map_model, distance_m, off_axis_deg * kDegree, 0.45);
}

Scan DoorWorld::scan() const {
  render::Scene scene;
  scene.add(model, T_map_model, values);
  const auto addBox = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    scene.add(cuboid(Eigen::AlignedBox3d(low, high)), T_map_model);
  };
  addBox({-6.0, -6.0, -0.1}, {6.0, 6.0, 0.0});
  if (has_wall) {
    addBox({-0.5, -6.0, 0.0}, {-0.4, 6.0, 3.0});
  }
  for (const Obstacle& obstacle : obstacles) {
    addBox(obstacle.box_model.min(), obstacle.box_model.max());
  }
  scene.commit();
  const camera::PinholeCamera camera = test::kinectCamera();
  cv::Mat depth_m = test::sensed(test::viewOf(scene, camera, T_map_camera), camera, sensor, 1);
  for (int u = 0; ramp != 0.0 && u < camera.width; ++u) {
    depth_m.col(u) *= 1.0 + ramp * 2.0 * (u - camera.cx) / camera.width;
  }
  return makeScan(depth_m, camera, {});
}

ArticulatedResult DoorWorld::registered(const std::vector<double>& joint_values, const ArticulatedConfig& config) const {
  return ArticulatedRegistration(model, config).run(scan(), T_map_camera, believed(joint_values));
}

}  // namespace oikos::registration
