// SPDX-License-Identifier: Apache-2.0
// A room with furniture, as it really stands and as it is believed to, before a camera that is not quite where it is thought to be.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/camera/sensor/depth_sensor.h"
#include "core/model/articulated_model.h"
#include "core/model/triangle_mesh.h"
#include "registration/landmark/camera_prior.h"
#include "registration/landmark/landmark_scene.h"
#include "registration/scan.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"

namespace oikos::registration {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Standing upright on the floor of map.
[[nodiscard]] Eigen::Isometry3d onFloor(double x, double y, double yaw_deg);

[[nodiscard]] std::shared_ptr<const model::TriangleMesh> box(const Eigen::Vector3f& size_m);

struct Piece {
  std::string id;
  test::FurnitureKind furniture;
  Eigen::Isometry3d T_map_model;
  std::vector<double> joint_values = {};  ///< empty: closed
};

/// Pieces in a room, as they really stand; and the camera before them, looking along y.
struct Room {
  std::vector<Piece> pieces = {{"fridge", {"fridge"}, onFloor(-1.0, 3.0, -90.0)},
                               {"cabinet", {"cabinet"}, onFloor(-0.1, 3.0, -90.0)},
                               {"drawers", {"drawer_unit"}, onFloor(0.8, 3.0, -90.0)},
                               {"shelf", {"shelf"}, onFloor(1.5, 1.9, -170.0)},
                               {"oven", {"oven"}, onFloor(-1.6, 1.9, 0.0)}};
  Eigen::Isometry3d T_map_camera = test::lookAt({0.0, -0.8, 1.2}, {0.0, 3.0, 0.7});
  std::vector<Eigen::Isometry3d> people = {};  ///< T_map_person
  std::vector<Eigen::Isometry3d> boxes = {};   ///< T_map_box, of what stands about: 12 cm wide and deep, 25 cm high
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kIdeal;

  [[nodiscard]] Piece& piece(const std::string& id);
  [[nodiscard]] Scan scan() const;
  /// As it is believed: call before anything is moved.
  [[nodiscard]] LandmarkScene believed() const;
};

/// The camera where it is thought to be: the robot, 10 cm behind it, is elsewhere.
[[nodiscard]] CameraPrior priorOff(const Eigen::Isometry3d& T_map_camera, double x_m, double y_m, double yaw_deg);

/// How far two poses are from each other.
struct PoseError {
  double metres;
  double degrees;
};
[[nodiscard]] PoseError between(const Eigen::Isometry3d& T_map_a, const Eigen::Isometry3d& T_map_b);

}  // namespace oikos::registration
