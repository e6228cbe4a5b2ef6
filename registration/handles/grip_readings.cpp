// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/grip_readings.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "registration/handles/pixel_area.h"

namespace oikos::registration {

namespace {

constexpr double kMostMargin_m = 0.015;  // within the hull
constexpr double kBehind_m = 0.03;       // what is so far behind the front is seen past its edge
constexpr double kMostOblique = 0.34;    // cosine between a ray and the normal, about 70 degrees
constexpr double kRim_m = 0.02;          // around the places that are searched, so that the front beside the handle is seen

/// Share of the rectangle that lies in the image, by a grid of its places.
double shareInView(const Eigen::AlignedBox2d& rectangle, const Eigen::Isometry3d& T_camera_plane, const camera::PinholeCamera& camera) {
  constexpr int kPlaces = 9;
  int inside = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double share = static_cast<double>(i) / (kPlaces - 1);
    const Eigen::Vector2d at = rectangle.min() + share * rectangle.sizes();
    const Eigen::Vector3d at_camera = T_camera_plane * Eigen::Vector3d(0.0, rectangle.center().x(), at.y());
    inside += at_camera.z() > 0.0 && camera.contains(camera.project(at_camera)) ? 1 : 0;
  }
  return static_cast<double>(inside) / kPlaces;
}

}  // namespace

Eigen::AlignedBox2d GripBelief::box_front() const {
  const Eigen::Vector2d along = T_front_handle.linear().col(2).tail<2>().cwiseAbs();
  const Eigen::Vector2d across = T_front_handle.linear().col(1).tail<2>().cwiseAbs();
  const Eigen::Vector2d half = half_length_m * along + half_width_m * across;
  const Eigen::Vector2d middle = T_front_handle.translation().tail<2>();
  return {middle - half, middle + half};
}

GripReadings readGrip(const GripBelief& belief, const FrontPlane& front, const DepthView& view, const GripConfig& config) {
  GripReadings grip;
  const Eigen::Isometry3d T_camera_handle = front.T_camera_front * belief.T_front_handle * belief.T_handle_seen();
  const Eigen::Isometry3d T_handle_camera = T_camera_handle.inverse();
  const Eigen::Isometry3d T_front_camera = front.T_camera_front.inverse();
  const Eigen::Vector3d eye_handle = T_handle_camera.translation();
  grip.faces_camera = eye_handle.normalized().x() > kMostOblique;
  const Eigen::Vector2d half(belief.half_width_m, belief.half_length_m);
  grip.in_view = shareInView({-half, half}, T_camera_handle, view.camera);
  if (!grip.faces_camera) {
    return grip;
  }
  const double rim_m = config.search_m + kRim_m;
  const Eigen::AlignedBox2d wide((-half).array() - rim_m, half.array() + rim_m);
  const PixelArea area = pixelsOf(wide, T_camera_handle, view.camera, config.most_readings);
  grip.share = std::min(1.0, area.step_px * area.step_px / (config.correlation_px * config.correlation_px));
  grip.pixel_m = T_camera_handle.translation().z() / view.camera.fx;
  grip.spacing_m = area.step_px * grip.pixel_m;
  grip.sigma_m = std::max(config.noise_floor_m, front.sigma_m);
  // nearer to its edge a front is mixed with what lies beside it: the edge of a worktop, the next drawer
  const double margin_m = std::min(kMostMargin_m, config.wide_blur_px * grip.pixel_m);
  for (int v = area.box.top; v < area.box.bottom; v += area.step_px) {
    const float* row = view.depth_m.ptr<float>(v);
    for (int u = area.box.left; u < area.box.right; u += area.step_px) {
      const Eigen::Vector3d ray = view.camera.ray(u, v);
      const Eigen::Vector3d ray_handle = T_handle_camera.linear() * ray;
      if (ray_handle.x() > -1e-6) {
        continue;
      }
      const Eigen::Vector3d met = eye_handle - ray_handle * (eye_handle.x() / ray_handle.x());
      const bool is_grip = std::abs(met.y()) <= half.x() && std::abs(met.z()) <= half.y();
      grip.shown += is_grip ? 1 : 0;
      const auto z_m = static_cast<double>(row[u]);
      if (!(z_m > 0.0) || !wide.contains(Eigen::Vector2d(met.tail<2>()))) {
        continue;
      }
      const Eigen::Vector3d at_front = T_front_camera * (z_m * ray);
      if (at_front.x() > config.max_reach_m) {
        grip.nearer += is_grip ? 1 : 0;
      } else if (at_front.x() > -kBehind_m && isWithin(front.hull_front, at_front.tail<2>(), -margin_m)) {
        grip.read += is_grip ? 1 : 0;
        grip.readings.push_back({met.z(), met.y(), at_front.x()});
      }
    }
  }
  return grip;
}

}  // namespace oikos::registration
