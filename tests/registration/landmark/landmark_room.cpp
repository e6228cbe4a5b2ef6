// SPDX-License-Identifier: Apache-2.0
#include "tests/registration/landmark/landmark_room.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "registration/motion.h"

namespace oikos::registration {

namespace {

std::vector<double> valuesOf(const Piece& p, const model::ArticulatedModel& model) {
  return p.joint_values.empty() ? std::vector<double>(model.joints.size(), 0.0) : p.joint_values;
}

}  // namespace

Eigen::Isometry3d onFloor(double x, double y, double yaw_deg) {
  return Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
}

std::shared_ptr<const model::TriangleMesh> box(const Eigen::Vector3f& size_m) {
  return std::make_shared<const model::TriangleMesh>(model::makeBox(size_m));
}

Piece& Room::piece(const std::string& id) {
  return *std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.id == id; });
}

Scan Room::scan() const {
  render::Scene world;
  for (const Piece& p : pieces) {
    const model::ArticulatedModel model = test::believed(p.furniture);
    world.add(model, p.T_map_model, valuesOf(p, model));
  }
  world.add(box({8.0F, 8.0F, 0.1F}), Eigen::Isometry3d(Eigen::Translation3d(0.0, 2.0, -0.05)));
  world.add(box({8.0F, 0.1F, 3.0F}), Eigen::Isometry3d(Eigen::Translation3d(0.0, 3.6, 1.5)));
  for (const Eigen::Isometry3d& T_map_person : people) {
    world.add(box({0.45F, 0.3F, 1.75F}), T_map_person * Eigen::Translation3d(0.0, 0.0, 0.875));
  }
  for (const Eigen::Isometry3d& T_map_box : boxes) {
    world.add(box({0.12F, 0.12F, 0.25F}), T_map_box * Eigen::Translation3d(0.0, 0.0, 0.125));
  }
  world.commit();
  const camera::PinholeCamera camera = test::kinectCamera();
  return makeScan(test::sensed(test::viewOf(world, camera, T_map_camera), camera, sensor, 1), camera, {});
}

LandmarkScene Room::believed() const {
  LandmarkScene scene;
  for (const Piece& p : pieces) {
    const model::ArticulatedModel model = test::believed(p.furniture);
    scene.add(p.id, model, p.T_map_model, valuesOf(p, model));
  }
  return scene;
}

CameraPrior priorOff(const Eigen::Isometry3d& T_map_camera, double x_m, double y_m, double yaw_deg) {
  CameraPrior prior;
  prior.robot_camera = {0.0, 0.0, -0.1};
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  twist << x_m, y_m, 0.0, 0.0, 0.0, yaw_deg * kDegree;
  prior.T_map_camera = motionAbout(T_map_camera * prior.robot_camera, twist) * T_map_camera;
  return prior;
}

PoseError between(const Eigen::Isometry3d& T_map_a, const Eigen::Isometry3d& T_map_b) {
  const Eigen::Isometry3d T_a_b = T_map_a.inverse() * T_map_b;
  return {T_a_b.translation().norm(), Eigen::AngleAxisd(T_a_b.linear()).angle() / kDegree};
}

}  // namespace oikos::registration
