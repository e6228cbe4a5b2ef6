// SPDX-License-Identifier: Apache-2.0
#include "registration/view_box.h"

#include <algorithm>
#include <cmath>

namespace oikos::registration {

namespace {

constexpr double kNearest_m = 0.1;
constexpr double kMargin_px = 8.0;  ///< for what looks at a pixel's neighbours

int clampedTo(int size_px, double pixel) {
  return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size_px)));
}

}  // namespace

PixelBox boxInView(const render::Scene& scene, const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera,
                   double margin_m) {
  Eigen::Array2d low(1e9, 1e9);
  Eigen::Array2d high(-1e9, -1e9);
  const Eigen::Isometry3d T_camera_map = T_map_camera.inverse();
  for (const render::ScenePart& part : scene.parts()) {
    const Eigen::Isometry3d T_camera_part = T_camera_map * part.T_map_part;
    for (const Eigen::Vector3f& vertex : part.mesh_part->vertices) {
      const Eigen::Vector3d point = T_camera_part * vertex.cast<double>();
      if (point.z() < kNearest_m) {
        return {0, 0, camera.width, camera.height};
      }
      const Eigen::Array2d pixel = camera.project(point).array();
      const double reach_px = kMargin_px + margin_m * camera.fx / point.z();
      low = low.min(pixel - reach_px);
      high = high.max(pixel + reach_px);
    }
  }
  return {clampedTo(camera.width, std::floor(low.x())), clampedTo(camera.height, std::floor(low.y())),
          clampedTo(camera.width, std::ceil(high.x()) + 1.0), clampedTo(camera.height, std::ceil(high.y()) + 1.0)};
}

}  // namespace oikos::registration
