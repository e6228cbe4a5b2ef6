// SPDX-License-Identifier: Apache-2.0
// Furniture as it was built, in a room, and as it is believed to be.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/depth_sensor.h"
#include "core/model/articulated_model.h"
#include "core/render/view.h"
#include "tests/registration/furniture_scan.h"

namespace oikos::bench {

using Random = std::mt19937_64;

struct WorldSettings {
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kKinect1;
  double dimension_m = 0.005;  ///< deviation of each length from the model's
  double axis_m = 0.003;       ///< of each coordinate of a joint's origin,
  double axis_deg = 0.5;       ///< of its turn about any axis
  double placement_m = 0.005;  ///< of x and y of the piece
  double placement_deg = 0.3;  ///< of its yaw
  double shift_m = 0.0;        ///< the piece stands so far from where it is believed, in any direction,
  double shift_deg = 0.0;      ///< and is turned so far, to either side
  double occluded = 0.0;       ///< share of the piece's width that a person stands before
  bool has_contents = true;    ///< boxes that no model has, on shelves and in drawers
};

struct WorldKind {
  std::string name;
  test::FurnitureKind shape;
};

struct World {
  std::string kind;
  model::ArticulatedModel real;
  model::ArticulatedModel believed;
  std::vector<double> values;  ///< of the joints, in truth
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
  double distance_m = 0.0;  ///< of the camera from the piece's middle
  double off_axis_rad = 0.0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// What the camera shows of a world.
struct Picture {
  camera::PinholeCamera camera;
  render::View view;               ///< without noise
  cv::Mat depth_m;                 ///< CV_32FC1, as the sensor has it
  std::vector<int> part_of_scene;  ///< by `view.part`: the part of the model, -1: none of it
};

/// Ten kinds, whose turns come one after the other.
[[nodiscard]] const std::vector<std::string>& worldKinds();
[[nodiscard]] World makeWorld(int number, const WorldSettings& settings, Random& random);
[[nodiscard]] World makeWorld(const WorldKind& kind, const WorldSettings& settings, Random& random);
/// Joint values as they come: a quarter closed, the others anywhere; a dishwasher's baskets stay behind its door.
[[nodiscard]] std::vector<double> randomState(const model::ArticulatedModel& real, const model::ArticulatedModel& believed, Random& random);
void lookFrom(double distance_m, double off_axis_rad, World& world);
/// `seed`: of the sensor's noise; contents and person come from `random`.
[[nodiscard]] Picture takePicture(const World& world, const WorldSettings& settings, std::uint64_t seed, Random& random);
[[nodiscard]] Eigen::Isometry3d believedPlace(const World& world, const WorldSettings& settings, Random& random);
/// By part of the model: pixels that show it and have a reading of it, over those of its largest face, seen straight on from there.
[[nodiscard]] std::vector<double> visibleShares(const World& world, const Picture& picture);

}  // namespace oikos::bench
