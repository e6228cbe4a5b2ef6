// SPDX-License-Identifier: Apache-2.0
#include "bench/missed/drive_past.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/degrees.h"
#include "core/camera/pinhole_camera.h"
#include "core/render/camera_rays.h"
#include "core/render/view.h"
#include "semantic/model/placement.h"
#include "tests/support/analytic_room.h"

namespace oikos::bench {

namespace {

/// Not in furniture, a wall or a neighbouring room: from there nothing is before the target.
bool isFree(const Eigen::Vector3d& eye_map, const Eigen::Vector3d& target_map, const simulate::World& world) {
  const Eigen::Vector2d eye = eye_map.head<2>();
  const auto footprints = world.footprints();
  if (std::any_of(footprints.begin(), footprints.end(), [&](const Eigen::AlignedBox2d& box) { return box.exteriorDistance(eye) < 0.15; })) {
    return false;
  }
  const camera::PinholeCamera ray{1, 1, 1.0, 1.0, 0.0, 0.0};
  const render::View view =
      render::renderView(world.scene(), render::CameraRays(ray), {test::lookAt(eye_map, target_map), {}}, render::ViewConfig());
  return static_cast<double>(view.depth_m.at<float>(0, 0)) > (target_map - eye_map).norm() - 0.35;
}

}  // namespace

std::vector<Carrier> carriersOf(const semantic::Home& home) {
  std::vector<Carrier> carriers;
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      Carrier carrier{object.id.value, {}, {}};
      for (const semantic::SmallObject& small : object.small_objects) {
        if (const auto T_map_parent = semantic::findCarrierInMap(object, small.parent)) {
          carrier.around_map.extend(*T_map_parent * small.T_parent_object.position_m);
          carrier.objects.insert(small.id.value);
        }
      }
      if (!carrier.objects.empty() && object.movability != semantic::Movability::kMovable) {
        carriers.push_back(std::move(carrier));
      }
    }
  }
  return carriers;
}

std::vector<Eigen::Isometry3d> drivePast(const Carrier& carrier, const simulate::World& world, int views, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const Eigen::Vector3d target = carrier.around_map.center() + Eigen::Vector3d(0.0, 0.0, 0.05);
  for (int attempt = 0; attempt < 300; ++attempt) {
    const double angle_rad = 2.0 * base::kRadPerDeg * 180.0 * share(random);
    const double height_m = 0.9 + 0.4 * share(random);
    const double step_m = 0.13 + 0.15 * share(random);
    Eigen::Vector3d eye = target + (0.9 + 1.5 * share(random)) * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    const Eigen::Vector3d step = step_m * Eigen::Vector3d(-std::sin(angle_rad), std::cos(angle_rad), 0.0);
    std::vector<Eigen::Isometry3d> drive;
    for (int i = 0; i < views; ++i, eye += step) {
      eye.z() = height_m;
      if (isFree(eye, target, world)) {
        const Eigen::Vector3d aside = 0.1 * Eigen::Vector3d(share(random) - 0.5, share(random) - 0.5, share(random) - 0.5);
        drive.push_back(test::lookAt(eye, target + aside));
      }
    }
    if (static_cast<int>(drive.size()) == views) {
      return drive;
    }
  }
  return {};
}

}  // namespace oikos::bench
