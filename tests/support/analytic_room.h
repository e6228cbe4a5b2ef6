// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"

namespace oikos::test {

/// An axis-aligned box in the map frame, each face of one colour.
struct AnalyticBox {
  Eigen::Vector3d min_map;
  Eigen::Vector3d max_map;
  std::array<unsigned char, 3> rgb;
};

/// A room with exact depth: the inside of one box (z up, floor at its lower face) with boxes standing in it. Walls and ceiling
/// are grey, the floor is brown.
class AnalyticRoom {
 public:
  AnalyticRoom(AnalyticBox room, std::vector<AnalyticBox> furniture) : room_(room), furniture_(std::move(furniture)) {}

  /// 4 m × 3 m × 2.5 m, the origin in the middle of the floor, a red table of 1.6 m × 0.8 m × 0.75 m on the side +x, a low blue
  /// chest.
  static AnalyticRoom furnished();

  /// Depth, colour and grey; no noise.
  [[nodiscard]] camera::RgbdFrame render(const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) const;

  /// Distance of a point to the nearest surface; for judging maps.
  [[nodiscard]] double distanceToSurface(const Eigen::Vector3d& point_map) const;

  struct Hit {
    double distance_m;  ///< in units of the direction's length
    std::array<unsigned char, 3> rgb;
  };
  [[nodiscard]] Hit castRay(const Eigen::Vector3d& origin_map, const Eigen::Vector3d& direction_map) const;

 private:
  AnalyticBox room_;
  std::vector<AnalyticBox> furniture_;
};

/// 160×120, 60° wide.
camera::PinholeCamera smallCamera();

/// A camera at `position_map` that looks at `target_map`, image-up towards +z.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& position_map, const Eigen::Vector3d& target_map);

/// `count` poses on a circle of `radius_m` around the room's middle at `height_m`, each looking outwards and down by `tilt_rad`.
std::vector<Eigen::Isometry3d> lookAround(int count, double radius_m, double height_m, double tilt_rad);

}  // namespace oikos::test
