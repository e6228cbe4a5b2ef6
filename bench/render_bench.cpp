// SPDX-License-Identifier: Apache-2.0
// What a picture costs: a kitchen of 100,000 triangles in 400 parts at 640x480 beside its depth alone, one cupboard at 160x120, and the
// next picture after a joint has moved.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "core/model/primitives.h"
#include "core/render/view.h"

namespace {

using namespace oikos;
using Clock = std::chrono::steady_clock;
using Mesh = model::TriangleMesh;

const camera::PinholeCamera kCamera{.width = 640, .height = 480, .fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5};

double medianMs(const std::function<void()>& action, int times) {
  std::vector<double> ms;
  for (int i = 0; i < times; ++i) {
    const Clock::time_point start = Clock::now();
    action();
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::nth_element(ms.begin(), ms.begin() + times / 2, ms.end());
  return ms[static_cast<std::size_t>(times / 2)];
}

std::shared_ptr<const Mesh> shared(Mesh mesh) {
  return std::make_shared<const Mesh>(std::move(mesh));
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A cupboard with two doors: its frame on the floor, x out of its front.
model::ArticulatedModel makeCupboard() {
  model::ArticulatedModel cupboard;
  cupboard.name = "cupboard";
  Mesh body;
  for (const double side : {-0.39, 0.39}) {
    append(body, model::makeBox({0.5F, 0.02F, 0.9F}), at(0.0, side, 0.45));
  }
  for (const double height : {0.01, 0.3, 0.6, 0.89}) {
    append(body, model::makeBox({0.5F, 0.76F, 0.02F}), at(0.0, 0.0, height));
  }
  append(body, model::makeBox({0.02F, 0.76F, 0.9F}), at(-0.24, 0.0, 0.45));
  cupboard.parts.push_back({"body", shared(body)});
  for (const double side : {-1.0, 1.0}) {
    Mesh door = model::makeBox({0.02F, 0.4F, 0.9F});
    append(door, model::makeCylinder({.radius_m = 0.006F, .length_m = 0.15F, .segments = 24}), at(0.04, side * 0.15, 0.0));
    Mesh moved;
    append(moved, door, at(0.0, -side * 0.2, 0.0));
    cupboard.parts.push_back({"door", shared(moved)});
    model::ModelJoint hinge;
    hinge.type = model::MotionType::kRevolute;
    hinge.child = static_cast<int>(cupboard.parts.size()) - 1;
    hinge.T_parent_joint = at(0.26, side * 0.4, 0.45);
    hinge.axis_joint = Eigen::Vector3d(0.0, 0.0, side);
    hinge.upper = 2.0;
    cupboard.joints.push_back(hinge);
  }
  return cupboard;
}

struct Kitchen {
  render::Scene scene;
  std::size_t triangles = 0;
};

/// A row of cupboards on two walls and what stands on them: 400 parts.
void furnish(Kitchen& kitchen) {
  render::Scene& scene = kitchen.scene;
  scene.add(shared(model::makeBox({6.0F, 6.0F, 0.1F})), at(0.0, 0.0, -0.05));
  scene.add(shared(model::makeBox({0.1F, 6.0F, 2.6F})), at(3.0, 0.0, 1.3));
  scene.add(shared(model::makeBox({6.0F, 0.1F, 2.6F})), at(0.0, 3.0, 1.3));
  const model::ArticulatedModel cupboard = makeCupboard();
  for (int i = 0; i < 60; ++i) {
    const double along = -2.4 + 0.8 * (i % 6);
    const Eigen::Isometry3d T =
        at(2.6 - 0.5 * (i / 12), along, i % 12 < 6 ? 0.0 : 1.4) * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ());
    scene.add(cupboard, T, {0.2 * (i % 5), 0.1 * (i % 7)});
  }
  const auto cup = shared(model::makeCylinder({.radius_m = 0.04F, .length_m = 0.1F, .segments = 96}));
  const auto ball = shared(model::makeSphere({.radius_m = 0.06F, .rings = 12}));
  while (scene.parts().size() < 400) {
    const auto n = static_cast<int>(scene.parts().size());
    scene.add(n % 2 == 0 ? cup : ball, at(2.5 - 0.5 * (n % 5), -2.5 + 0.031 * (n % 160), 0.96));
  }
  for (const render::ScenePart& part : scene.parts()) {
    kitchen.triangles += part.mesh_part->triangles.size();
  }
  scene.commit();
}

render::Viewpoint lookAlongX(const Eigen::Vector3d& eye_map) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, -0.2873, 0.9578, -1, 0, 0, 0, -0.9578, -0.2873;
  T.translation() = eye_map;
  return {T, {}};
}

render::ViewConfig config(bool with_all, bool with_color, int threads) {
  render::ViewConfig config;
  config.with_normals = config.with_parts = with_all;
  config.with_color = with_color;
  config.threads = threads;
  config.lighting.lamps = {{Eigen::Vector3d(0.0, 0.0, 2.4), Eigen::Vector3f::Constant(1.5F)}};
  return config;
}

void benchViews(const Kitchen& kitchen) {
  const render::CameraRays rays(kCamera);
  const render::CameraRays bent(kCamera, camera::LensDistortion{.k1 = 0.1, .k2 = -0.2});
  const render::Viewpoint viewpoint = lookAlongX({-2.0, -0.3, 1.5});
  std::printf("kitchen: %zu triangles, %zu parts, 640x480          1 thread  2 threads, ms\n", kitchen.triangles,
              kitchen.scene.parts().size());
  const auto row = [&](const char* what, const render::CameraRays& camera, bool with_all, bool with_color) {
    std::printf("%-52s", what);
    for (const int threads : {1, 2}) {
      std::printf("%10.2f",
                  medianMs([&] { (void)renderView(kitchen.scene, camera, viewpoint, config(with_all, with_color, threads)); }, 31));
    }
    std::printf("\n");
  };
  row("depth", rays, false, false);
  row("depth, normals, parts", rays, true, false);
  row("the same with lens distortion", bent, true, false);
  row("depth, normals, parts, colour with one lamp", rays, true, true);
}

void benchCupboard() {
  render::Scene scene;
  scene.add(makeCupboard(), at(0.0, 0.0, 0.0), {0.3, 0.5});
  scene.commit();
  const camera::PinholeCamera small{.width = 160, .height = 120, .fx = 131.25, .fy = 131.25, .cx = 79.5, .cy = 59.5};
  const render::CameraRays rays(small);
  render::Viewpoint viewpoint = lookAlongX({1.8, 0.0, 1.0});
  viewpoint.T_map_camera.linear() = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()) * viewpoint.T_map_camera.linear();
  for (const int threads : {1, 2}) {
    std::printf("one cupboard, 160x120, depth, normals, parts, %d thread(s): %.3f ms\n", threads,
                medianMs([&] { (void)renderView(scene, rays, viewpoint, config(true, false, threads)); }, 301));
  }
  double value = 0.0;
  std::printf("moving one of its joints: %.1f us\n", 1000.0 * medianMs(
                                                                  [&] {
                                                                    scene.move(0, at(0.0, 0.0, 0.0), {value += 1e-4, 0.5});
                                                                    scene.commit();
                                                                  },
                                                                  1001));
}

void benchMoving(Kitchen& kitchen) {
  double value = 0.0;
  std::printf("moving one joint in the kitchen: %.1f us\n", 1000.0 * medianMs(
                                                                         [&] {
                                                                           kitchen.scene.move(7, at(2.0, 0.0, 0.0), {value += 1e-4, 0.5});
                                                                           kitchen.scene.commit();
                                                                         },
                                                                         1001));
}

}  // namespace

int main() {
  Kitchen kitchen;
  furnish(kitchen);
  benchViews(kitchen);
  benchMoving(kitchen);
  benchCupboard();
}
