// SPDX-License-Identifier: Apache-2.0
// Furniture in a bare room as a depth camera records it, beside the model that is believed of it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/depth_sensor.h"
#include "core/model/articulated_model.h"
#include "core/model/shapes/shape_text.h"
#include "core/render/view.h"
#include "registration/scan.h"

namespace oikos::test {

/// 640×480, 525 px: a Kinect.
[[nodiscard]] camera::PinholeCamera kinectCamera();

struct FurnitureKind {
  std::string kind;
  model::Dimensions dimensions = {};  ///< what is different from the shape's usual ones
};

/// Ten kinds of a home's large furniture.
[[nodiscard]] const std::vector<FurnitureKind>& furnitureKinds();

/// The shape as it really is: each length off by a normal error, as a tape measures.
[[nodiscard]] model::ArticulatedModel trulyBuilt(const FurnitureKind& furniture, double dimension_sigma_m, std::mt19937_64& random);
/// The shape as it is believed.
[[nodiscard]] model::ArticulatedModel believed(const FurnitureKind& furniture);

struct FurnitureScene {
  const model::ArticulatedModel* model = nullptr;  ///< as built
  std::vector<double> joint_values;
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  bool has_wall = true;       ///< right behind the piece
  bool has_occluder = false;  ///< a person-sized box before it
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kKinect1;
  std::uint64_t noise_seed = 1;
};

/// With normals, parts and what a sensor asks of surfaces.
[[nodiscard]] render::View viewOf(const render::Scene& scene, const camera::PinholeCamera& camera,
                                  const Eigen::Isometry3d& T_map_camera = Eigen::Isometry3d::Identity());
/// What a sensor makes of it: CV_32FC1, NaN = no reading.
[[nodiscard]] cv::Mat sensed(const render::View& view, const camera::PinholeCamera& camera, camera::DepthSensorKind kind,
                             std::uint64_t seed);

/// The depth image that the sensor records, CV_32FC1, NaN = no reading.
[[nodiscard]] cv::Mat recordDepth(const FurnitureScene& scene, const camera::PinholeCamera& camera);

/// A camera at `distance_m` from the middle of the piece, `off_axis_rad` to the side of what its front (x) faces, 1.3 m high, looking at
/// it.
[[nodiscard]] Eigen::Isometry3d cameraBefore(const Eigen::Isometry3d& T_map_model, double distance_m, double off_axis_rad,
                                             double target_height_m);

}  // namespace oikos::test
