// SPDX-License-Identifier: Apache-2.0
#include "bench/change/changed_room.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/geometry/se3.h"
#include "core/model/primitives.h"
#include "core/render/scene.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"

namespace oikos::bench {

namespace {

const Eigen::Vector3d kRoom_m(6.0, 5.0, 2.5);
constexpr double kDiscRadius_m = 1.1;
constexpr double kGap_m = 0.25;

double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Eigen::Vector3d normalVector(double rms, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, rms / std::sqrt(3.0));
  const double x = normal(random);
  const double y = normal(random);
  return {x, y, normal(random)};
}

bool fits(const BoxM& box, const std::vector<BoxM>& others) {
  const Eigen::AlignedBox2d footprint(box.min().head<2>(), box.max().head<2>());
  if (footprint.exteriorDistance(Eigen::Vector2d::Zero()) < kDiscRadius_m) {
    return false;
  }
  const Eigen::Vector3d gap = Eigen::Vector3d::Constant(kGap_m);
  const BoxM wide(box.min() - gap, box.max() + gap);
  return std::none_of(others.begin(), others.end(), [&](const BoxM& other) { return wide.intersects(other); });
}

/// Somewhere on the floor, a third of them against a wall.
BoxM place(const Eigen::Vector3d& size_m, const std::vector<BoxM>& others, std::mt19937_64& random) {
  BoxM box;
  do {
    Eigen::Vector3d corner(0.0, 0.0, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
      const double reach_m = 0.5 * kRoom_m[axis] - size_m[axis];
      corner[axis] =
          uniform(0.0, 1.0, random) < 0.18 ? -0.5 * kRoom_m[axis] + 0.005 : uniform(-0.5 * kRoom_m[axis] + 0.05, reach_m - 0.05, random);
    }
    box = BoxM(corner, corner + size_m);
  } while (!fits(box, others));
  return box;
}

Eigen::Vector3d randomSize(std::mt19937_64& random) {
  const double x = uniform(0.3, 0.9, random);
  const double y = uniform(0.3, 0.9, random);
  return {x, y, uniform(0.35, 1.3, random)};
}

void addBox(render::Scene& scene, const BoxM& box, const Eigen::Vector3f& color_rgb) {
  const Eigen::Vector3f size = box.sizes().cast<float>();
  model::TriangleMesh mesh = model::makeBox(size);
  mesh.materials.assign(1, {});
  mesh.materials[0].color_rgb = color_rgb;
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  scene.add(std::make_shared<const model::TriangleMesh>(std::move(mesh)), Eigen::Isometry3d(Eigen::Translation3d(box.center())));
}

void build(render::Scene& scene, const Room& room) {
  const Eigen::Vector3d half(0.5 * kRoom_m.x(), 0.5 * kRoom_m.y(), 0.0);
  const Eigen::Vector3d low = -half;
  const Eigen::Vector3d high = half + Eigen::Vector3d(0.0, 0.0, kRoom_m.z());
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      BoxM slab(low - Eigen::Vector3d::Constant(0.1), high + Eigen::Vector3d::Constant(0.1));
      (upper ? slab.min() : slab.max())[axis] = upper ? high[axis] : low[axis];
      addBox(scene, slab, {0.8F, 0.8F, 0.75F});
    }
  }
  for (const BoxM& piece : room.furniture) {
    addBox(scene, piece, {0.5F, 0.4F, 0.3F});
  }
  scene.commit();
}

Eigen::Isometry3d ringPose(double turn, std::mt19937_64& random) {
  const double yaw = 2.0 * std::numbers::pi * turn;
  const Eigen::Vector3d out(std::cos(yaw), std::sin(yaw), 0.0);
  const Eigen::Vector3d eye = uniform(-0.8, 0.8, random) * out + uniform(0.9, 1.4, random) * Eigen::Vector3d::UnitZ();
  return test::lookAt(eye, eye + out - uniform(0.2, 0.6, random) * Eigen::Vector3d::UnitZ());
}

Eigen::Isometry3d wandererPose(const Room& room, std::mt19937_64& random) {
  Eigen::Vector3d eye;
  do {
    const double x = uniform(-0.5 * kRoom_m.x() + 0.4, 0.5 * kRoom_m.x() - 0.4, random);
    const double y = uniform(-0.5 * kRoom_m.y() + 0.4, 0.5 * kRoom_m.y() - 0.4, random);
    eye = {x, y, uniform(0.9, 1.4, random)};
  } while (std::any_of(room.furniture.begin(), room.furniture.end(), [&](const BoxM& piece) {
    return Eigen::AlignedBox2d(piece.min().head<2>(), piece.max().head<2>()).exteriorDistance(Eigen::Vector2d(eye.head<2>())) < 0.4;
  }));
  const double yaw = uniform(-0.7, 0.7, random) + std::atan2(-eye.y(), -eye.x());
  return test::lookAt(eye, eye + Eigen::Vector3d(std::cos(yaw), std::sin(yaw), -uniform(0.2, 0.6, random)));
}

mapping::LocatedScan record(const render::Scene& scene, const Eigen::Isometry3d& T_map_true, const PoseNoise& noise,
                            std::mt19937_64& random) {
  mapping::LocatedScan scan;
  scan.camera = test::kinectCamera();
  scan.depth_m = test::sensed(test::viewOf(scene, scan.camera, T_map_true), scan.camera, camera::DepthSensorKind::kKinect1, random());
  const Eigen::Vector3d shift = normalVector(noise.translation_m, random);
  const Eigen::Vector3d turn = normalVector(noise.rotation_rad, random);
  const double angle = turn.norm();
  scan.T_map_camera = T_map_true * Eigen::Translation3d(shift) *
                      Eigen::AngleAxisd(angle, angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX());
  scan.covariance.diagonal().head<3>().setConstant(noise.translation_m * noise.translation_m / 3.0);
  scan.covariance.diagonal().tail<3>().setConstant(noise.rotation_rad * noise.rotation_rad / 3.0);
  return scan;
}

}  // namespace

Room randomRoom(int pieces, std::mt19937_64& random) {
  Room room;
  room.furniture.reserve(static_cast<std::size_t>(pieces));
  for (int i = 0; i < pieces; ++i) {
    room.furniture.push_back(place(randomSize(random), room.furniture, random));
  }
  return room;
}

ChangedRoom changeRoom(const Room& room, int events, std::mt19937_64& random) {
  ChangedRoom changed;
  std::vector<BoxM> untouched = room.furniture;
  std::shuffle(untouched.begin(), untouched.end(), random);
  std::vector<BoxM> taken = room.furniture;  // new pieces keep clear of what stood there, too: hidden inside of it nothing is known
  std::vector<BoxM> placed;
  for (int i = 0; i < events; ++i) {
    RoomEvent event{static_cast<EventKind>(random() % 3), BoxM(), BoxM()};
    Eigen::Vector3d size_m = randomSize(random);
    if (event.kind != EventKind::kAdded) {
      event.before = untouched.back();
      untouched.pop_back();
      size_m = event.before.sizes();
    }
    if (event.kind != EventKind::kRemoved) {
      event.after = place(size_m, taken, random);
      taken.push_back(event.after);
      placed.push_back(event.after);
    }
    changed.events.push_back(event);
  }
  changed.room.furniture = untouched;
  changed.room.furniture.insert(changed.room.furniture.end(), placed.begin(), placed.end());
  return changed;
}

std::vector<mapping::LocatedScan> drive(const Room& room, const DriveSize& size, const PoseNoise& noise, std::mt19937_64& random) {
  render::Scene scene;
  build(scene, room);
  std::vector<mapping::LocatedScan> scans;
  const double phase = uniform(0.0, 1.0, random);
  for (int i = 0; i < size.ring; ++i) {
    scans.push_back(record(scene, ringPose(phase + static_cast<double>(i) / std::min(size.ring, 12), random), noise, random));
  }
  for (int i = 0; i < size.wanderer; ++i) {
    scans.push_back(record(scene, wandererPose(room, random), noise, random));
  }
  return scans;
}

}  // namespace oikos::bench
