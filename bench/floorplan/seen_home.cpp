// SPDX-License-Identifier: Apache-2.0
#include "bench/floorplan/seen_home.h"

#include <algorithm>
#include <numbers>

#include "core/base/degrees.h"
#include "core/camera/sensor/depth_sensor.h"
#include "core/render/view.h"
#include "mapping/volume/depth_filter.h"
#include "semantic/model/outline.h"
#include "semantic/xml/home_reader.h"
#include "tools/simulate/dice.h"
#include "tools/simulate/rig.h"
#include "tools/simulate/true_home.h"
#include "tools/simulate/world.h"

namespace oikos::bench {

namespace {

constexpr int kPlacesARoom = 4;
constexpr int kViewsAPlace = 10;
constexpr double kFromWall_m = 0.5;
constexpr double kFromFurniture_m = 0.3;

void openDoors(semantic::Home& home) {
  for (semantic::Room& room : home.rooms) {
    for (auto& object : room.objects) {
      if (object->type == "door" && object->articulation) {
        for (semantic::Joint& joint : object.edit().articulation->joints) {
          joint.value = joint.type == semantic::JointType::kRevolute ? std::min(joint.upper, 95.0 * base::kRadPerDeg) : joint.value;
        }
      }
    }
  }
}

simulate::BeliefSettings tapeErrors() {
  simulate::BeliefSettings belief;
  belief.dimension_m = 0.005;
  belief.placement_m = 0.01;
  belief.placement_deg = 0.5;
  belief.wall_deg = 0.5;
  return belief;
}

/// Places in a room where a robot could stand; fewer than asked for if the room is full.
std::vector<Eigen::Vector2d> placesIn(const semantic::Room& room, const std::vector<Eigen::AlignedBox2d>& footprints,
                                      simulate::Dice& dice) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : room.outline_map) {
    box.extend(corner);
  }
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 2000 && places.size() < kPlacesARoom; ++i) {
    const Eigen::Vector2d place = box.min() + Eigen::Vector2d(dice.next(), dice.next()).cwiseProduct(box.sizes());
    const bool is_free = std::all_of(footprints.begin(), footprints.end(),
                                     [&](const Eigen::AlignedBox2d& f) { return f.exteriorDistance(place) > kFromFurniture_m; });
    const bool is_new =
        std::all_of(places.begin(), places.end(), [&](const Eigen::Vector2d& other) { return (other - place).norm() > 0.7; });
    if (is_free && is_new && semantic::isInside(place, room.outline_map) &&
        semantic::distanceToEdge(place, room.outline_map) > kFromWall_m) {
      places.push_back(place);
    }
  }
  return places;
}

Eigen::Isometry3d cameraAt(const Eigen::Vector2d& place, double yaw_rad, const Eigen::Isometry3d& T_base_camera) {
  return simulate::FloorPose{place, yaw_rad}.T_map_base() * T_base_camera;
}

}  // namespace

SeenHome::SeenHome(const std::filesystem::path& folder, std::uint64_t seed, int threads)
    : name_(folder.filename().string()), believed_(semantic::getHome(semantic::readHome(folder / "home.xml"), folder / "home.xml")) {
  semantic::Home home = simulate::makeTrueHome(believed_, tapeErrors(), seed);
  openDoors(home);
  const simulate::World world(home, {folder, seed, 2.5, 0.0, threads});
  const camera::Calibration calibration = simulate::nominalCalibration({});
  camera_ = calibration.color;
  const render::CameraRays rays(camera_);
  render::ViewConfig view_config;
  view_config.with_normals = true;
  view_config.with_surface = true;
  view_config.threads = threads;
  const camera::DepthSensorConfig sensor;
  simulate::Dice dice(seed + 17);
  std::int64_t frame = 0;
  for (const semantic::Room& room : home.rooms) {
    for (const Eigen::Vector2d& place : placesIn(room, world.footprints(), dice)) {
      for (int turn = 0; turn < kViewsAPlace; ++turn) {
        const double yaw_rad = (turn + dice.next()) * 2.0 * std::numbers::pi / kViewsAPlace;
        T_map_camera_.push_back(cameraAt(place, yaw_rad, *calibration.T_base_camera));
        const render::View view = renderView(world.scene(), rays, {T_map_camera_.back(), {}}, view_config);
        const cv::Mat raw =
            senseDepth({view.depth_m, view.normal_camera, view.albedo, view.gloss}, camera_, sensor, {seed, frame++, threads});
        cv::Mat depth_m;
        raw.convertTo(depth_m, CV_32FC1, 1.0 / sensor.units_per_m);
        depth_m.setTo(std::numeric_limits<float>::quiet_NaN(), raw == 0);
        depths_m_.push_back(mapping::filterDepth(depth_m, {}));
      }
    }
  }
}

mapping::WallSketch SeenHome::sketch(const Eigen::Isometry2d& T_map_level) const {
  Eigen::Isometry3d T_level_map = Eigen::Isometry3d::Identity();
  const Eigen::Isometry2d inverse = T_map_level.inverse();
  T_level_map.linear().topLeftCorner<2, 2>() = inverse.linear();
  T_level_map.translation().head<2>() = inverse.translation();
  mapping::WallScan scan({});
  for (std::size_t i = 0; i < depths_m_.size(); ++i) {
    scan.add(depths_m_[i], camera_, T_level_map * T_map_camera_[i]);
  }
  return scan.sketch();
}

}  // namespace oikos::bench
