// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/camera/pinhole_camera.h"
#include "registration/scan.h"

namespace oikos::registration {

/// Pixels of a depth image, one in so many columns and rows.
struct PixelArea {
  PixelBox box;
  int step_px = 1;
};

/// Those that a rectangle (y, z) in the plane x = 0 of a frame covers, thinned to about `most`; all of the image if it reaches behind the
/// camera.
[[nodiscard]] inline PixelArea pixelsOf(const Eigen::AlignedBox2d& rectangle, const Eigen::Isometry3d& T_camera_plane,
                                        const camera::PinholeCamera& camera, int most) {
  constexpr double kNearest_m = 0.1;
  Eigen::AlignedBox2d seen;
  for (const auto corner :
       {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight, Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
    const Eigen::Vector2d at = rectangle.corner(corner);
    const Eigen::Vector3d corner_camera = T_camera_plane * Eigen::Vector3d(0.0, at.x(), at.y());
    if (corner_camera.z() < kNearest_m) {
      seen = Eigen::AlignedBox2d(Eigen::Vector2d::Zero(), Eigen::Vector2d(camera.width, camera.height));
      break;
    }
    seen.extend(camera.project(corner_camera));
  }
  const auto within = [](double pixel, int size) { return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size))); };
  PixelArea area;
  area.box = {within(std::floor(seen.min().x()), camera.width), within(std::floor(seen.min().y()), camera.height),
              within(std::ceil(seen.max().x()) + 1.0, camera.width), within(std::ceil(seen.max().y()) + 1.0, camera.height)};
  const double pixels = std::max(0, area.box.right - area.box.left) * static_cast<double>(std::max(0, area.box.bottom - area.box.top));
  area.step_px = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / most))));
  return area;
}

}  // namespace oikos::registration
