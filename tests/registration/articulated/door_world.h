// SPDX-License-Identifier: Apache-2.0
// A piece of furniture in a bare room, seen by a perfect camera, and what is believed of it.
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <vector>

#include "registration/articulated/articulated_registration.h"
#include "tests/registration/furniture_scan.h"

namespace oikos::registration {

constexpr double kDegree = std::numbers::pi / 180.0;

// Depths are exact, but a pixel in four rows and columns is looked at, and a door's place is taken to be uncertain by 4 mm.
constexpr double kDoorTolerance_rad = 0.5 * kDegree;
constexpr double kDrawerTolerance_m = 0.004;

/// Expects two poses to be the same but for this.
void expectSame(const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b, double tolerance_m, double tolerance_rad);

/// An upright box of the room, from corner to corner in the model's frame.
struct Obstacle {
  Eigen::AlignedBox3d box_model;
};

struct DoorWorld {
  model::ArticulatedModel model;
  std::vector<double> values;  ///< of the joints, in truth
  Eigen::Isometry3d T_map_model = Eigen::Translation3d(0.4, -0.3, 0.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  std::vector<Obstacle> obstacles;
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kIdeal;
  bool has_wall = true;
  double ramp = 0.0;  ///< what depth is wrong by: by so much of the distance more at the picture's right border than in its middle

  explicit DoorWorld(model::ArticulatedModel built);
  DoorWorld(const std::string& kind, const model::Dimensions& dimensions) : DoorWorld(model::makeShape(kind, dimensions, kind)) {}

  /// The camera `distance_m` from the model's middle, `off_axis_deg` to the left of what the model faces, 1.3 m high.
  void lookFrom(double distance_m, double off_axis_deg);
  [[nodiscard]] Scan scan() const;
  /// The model where it is, with its joints believed at these values.
  [[nodiscard]] Standing believed(const std::vector<double>& joint_values) const { return {T_map_model, joint_values}; }
  [[nodiscard]] ArticulatedResult registered(const std::vector<double>& joint_values, const ArticulatedConfig& config = {}) const;
};

/// A cuboid as a part's mesh.
[[nodiscard]] std::shared_ptr<const model::TriangleMesh> cuboid(const Eigen::AlignedBox3d& box_part);

}  // namespace oikos::registration
