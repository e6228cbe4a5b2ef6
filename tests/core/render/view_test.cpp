// SPDX-License-Identifier: Apache-2.0
// Depths and normals against closed forms and against a brute-force caster in double precision.
#include "core/render/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/model/primitives.h"

namespace oikos::render {
namespace {

using Mesh = model::TriangleMesh;

const camera::PinholeCamera kCamera{.width = 81, .height = 61, .fx = 70.0, .fy = 71.0, .cx = 39.7, .cy = 30.2};

std::shared_ptr<const Mesh> shared(Mesh mesh) {
  return std::make_shared<const Mesh>(std::move(mesh));
}

Eigen::Isometry3d poseFrom(std::mt19937_64& random, double reach_m) {
  const auto number = [&] { return static_cast<double>(random() % 2000001) / 1e6 - 1.0; };
  const Eigen::Quaterniond turned(number(), number(), number(), number());
  Eigen::Isometry3d T(turned.normalized());
  T.translation() = reach_m * Eigen::Vector3d(number(), number(), number());
  return T;
}

/// Some way before the camera.
Eigen::Isometry3d ahead(double distance_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, distance_m));
}

ViewConfig everything() {
  ViewConfig config;
  config.with_normals = config.with_parts = config.with_color = config.with_surface = true;
  config.lighting.lamps.push_back({Eigen::Vector3d(1.0, -2.0, 0.0), Eigen::Vector3f(2.0F, 1.9F, 1.8F)});
  return config;
}

std::vector<cv::Mat> imagesOf(const View& view) {
  return {view.depth_m, view.normal_camera, view.part, view.color, view.albedo, view.gloss};
}

bool sameBytes(const View& a, const View& b) {
  const std::vector<cv::Mat> first = imagesOf(a);
  const std::vector<cv::Mat> second = imagesOf(b);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::size_t bytes = first[i].total() * first[i].elemSize();
    if (bytes == 0 || bytes != second[i].total() * second[i].elemSize() || std::memcmp(first[i].data, second[i].data, bytes) != 0) {
      return false;
    }
  }
  return true;
}

/// Depth at which the ray enters a box around its frame's origin, and the face's normal there.
struct BoxHit {
  double depth_m = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d normal_box = Eigen::Vector3d::Zero();
};

BoxHit enterBox(const Eigen::Vector3d& half_size_m, const Eigen::Vector3d& origin_box, const Eigen::Vector3d& direction_box) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = -enter;
  int side = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-half_size_m[axis] - origin_box[axis]) / direction_box[axis];
    const double b = (half_size_m[axis] - origin_box[axis]) / direction_box[axis];
    if (std::min(a, b) > enter) {
      enter = std::min(a, b);
      side = axis;
    }
    leave = std::min(leave, std::max(a, b));
  }
  return enter > leave ? BoxHit{} : BoxHit{enter, -std::copysign(1.0, direction_box[side]) * Eigen::Vector3d::Unit(side)};
}

TEST(RenderView, ABoxIsWhereItsClosedFormIs) {
  std::mt19937_64 random(7);
  const Eigen::Vector3f size_m(0.6F, 1.2F, 1.8F);
  const CameraRays rays(kCamera);
  ViewConfig config;
  config.with_normals = true;
  int compared = 0;
  int disagree = 0;
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Isometry3d T_camera_box = poseFrom(random, 0.5);
    T_camera_box.translation().z() += 3.0;
    const Eigen::Isometry3d T_map_camera = poseFrom(random, 5.0);
    Scene scene;
    scene.add(shared(model::makeBox(size_m)), T_map_camera * T_camera_box);
    scene.commit();
    const View view = renderView(scene, rays, {T_map_camera, {}}, config);
    const Eigen::Isometry3d T_box_camera = T_camera_box.inverse();
    for (int v = 0; v < kCamera.height; ++v) {
      for (int u = 0; u < kCamera.width; ++u) {
        const BoxHit expected =
            enterBox(0.5 * size_m.cast<double>(), T_box_camera.translation(), T_box_camera.linear() * kCamera.ray(u, v));
        const float depth_m = view.depth_m.at<float>(v, u);
        if (std::isnan(expected.depth_m) || std::isnan(depth_m)) {
          disagree += std::isnan(expected.depth_m) == std::isnan(depth_m) ? 0 : 1;
          continue;
        }
        ++compared;
        EXPECT_NEAR(depth_m, expected.depth_m, 1e-5);
        const cv::Vec3f normal = view.normal_camera.at<cv::Vec3f>(v, u);
        const Eigen::Vector3d seen(normal[0], normal[1], normal[2]);
        const double off = (seen - T_camera_box.linear() * expected.normal_box).norm();
        disagree += off > 1e-4 ? 1 : 0;  // on an edge the other of its faces
      }
    }
  }
  EXPECT_GT(compared, 20000);
  EXPECT_LE(disagree, compared / 5000);
}

TEST(RenderView, ASphereIsWithinItsChordsAndSmooth) {
  constexpr float kRadius_m = 0.5F;
  constexpr int kRings = 64;
  Scene scene;
  scene.add(shared(model::makeSphere({.radius_m = kRadius_m, .rings = kRings})), ahead(2.0));
  scene.commit();
  ViewConfig config;
  config.with_normals = true;
  const View view = renderView(scene, CameraRays(kCamera), {}, config);
  const double chord_m = kRadius_m * (1.0 - std::cos(std::numbers::pi / kRings));
  const Eigen::Vector3d centre(0.0, 0.0, 2.0);
  int compared = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Eigen::Vector3d ray = kCamera.ray(u, v).normalized();
      const double along = ray.dot(centre);
      const double aside_sq = centre.squaredNorm() - along * along;
      if (aside_sq > std::pow(0.9 * kRadius_m, 2)) {
        continue;
      }
      const double distance = along - std::sqrt(kRadius_m * kRadius_m - aside_sq);
      const double facing = std::sqrt(1.0 - aside_sq / (kRadius_m * kRadius_m));
      const Eigen::Vector3d normal = (distance * ray - centre) / kRadius_m;
      // A ring's quadrangles are flat in two directions: twice the chord.
      EXPECT_GE(view.depth_m.at<float>(v, u), distance * ray.z() - 1e-6);
      EXPECT_LE(view.depth_m.at<float>(v, u), distance * ray.z() + 2.0 * chord_m / facing + 1e-6);
      const cv::Vec3f seen = view.normal_camera.at<cv::Vec3f>(v, u);
      EXPECT_NEAR((Eigen::Vector3d(seen[0], seen[1], seen[2]) - normal).norm(), 0.0, 0.5 * std::numbers::pi / kRings / facing);
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(RenderView, ACylinderIsWithinItsChords) {
  constexpr float kRadius_m = 0.3F;
  constexpr int kSegments = 48;
  Scene scene;
  const Eigen::Isometry3d T_map_cylinder = ahead(2.0) * Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitX());
  scene.add(shared(model::makeCylinder({.radius_m = kRadius_m, .length_m = 4.0F, .segments = kSegments})), T_map_cylinder);
  scene.commit();
  const View view = renderView(scene, CameraRays(kCamera), {}, {});
  const double chord_m = kRadius_m * (1.0 - std::cos(std::numbers::pi / kSegments));
  for (int u = 31; u <= 48; ++u) {  // its axis lies along the image's y: each column is the same distance away
    const double x = kCamera.ray(u, 0.0).x();
    const double a = x * x + 1.0;
    const double depth_m = (2.0 - std::sqrt(4.0 - a * (4.0 - kRadius_m * kRadius_m))) / a;
    const double facing = std::abs((depth_m - 2.0) + x * x * depth_m) / (kRadius_m * std::sqrt(a));
    for (int v = 0; v < kCamera.height; ++v) {
      EXPECT_GE(view.depth_m.at<float>(v, u), depth_m - 1e-6);
      EXPECT_LE(view.depth_m.at<float>(v, u), depth_m + chord_m / facing + 1e-6);
    }
  }
}

struct BruteHit {
  int part = -1;
  double depth_m = std::numeric_limits<double>::infinity();
};

/// Möller and Trumbore's test over all triangles.
BruteHit castBrute(const Scene& scene, const Eigen::Vector3d& direction) {
  BruteHit nearest;
  for (std::size_t p = 0; p < scene.parts().size(); ++p) {
    const ScenePart& part = scene.parts()[p];
    for (const Mesh::Triangle& triangle : part.mesh_part->triangles) {
      std::array<Eigen::Vector3d, 3> corner;
      for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = part.T_map_part * part.mesh_part->vertices[triangle[i]].cast<double>();
      }
      Eigen::Matrix3d A;
      A << corner[1] - corner[0], corner[2] - corner[0], -direction;
      const Eigen::Vector3d solution = A.inverse() * -corner[0];  // u, v, depth
      if (solution.x() >= 0.0 && solution.y() >= 0.0 && solution.x() + solution.y() <= 1.0 && solution.z() > 0.02 &&
          solution.z() < nearest.depth_m) {
        nearest = {static_cast<int>(p), solution.z()};
      }
    }
  }
  return nearest;
}

Mesh randomMesh(std::mt19937_64& random, int triangles) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Eigen::Vector3d centre = poseFrom(random, 1.0).translation();
    for (int corner = 0; corner < 3; ++corner) {
      mesh.vertices.emplace_back((centre + poseFrom(random, 0.3).translation()).cast<float>());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(RenderView, FindsWhatABruteForceCasterFinds) {
  std::mt19937_64 random(11);
  const camera::LensDistortion distortion{.k1 = 0.1, .k2 = -0.05, .p1 = 0.002, .p2 = -0.001, .k3 = 0.0};
  const CameraRays rays(kCamera, distortion);
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    scene.add(shared(randomMesh(random, 60)), ahead(2.5) * poseFrom(random, 0.4));
  }
  scene.commit();
  ViewConfig config;
  config.with_parts = true;
  const View view = renderView(scene, rays, {}, config);
  int hits = 0;
  int disagree = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const BruteHit expected = castBrute(scene, rays.at(u, v).homogeneous());
      hits += expected.part >= 0 ? 1 : 0;
      const bool is_same = view.part.at<std::int32_t>(v, u) == expected.part &&
                           (expected.part < 0 || std::abs(view.depth_m.at<float>(v, u) - expected.depth_m) < 1e-5);
      disagree += is_same ? 0 : 1;
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_LE(disagree, 2);  // a ray that meets an edge
}

model::ArticulatedModel doorModel() {
  model::ArticulatedModel model;
  model.name = "door";
  model.parts = {{"frame", shared(model::makeBox({1.0F, 0.1F, 0.1F}))}, {"leaf", shared(model::makeBox({0.8F, 0.03F, 1.2F}))}};
  model::ModelJoint hinge;
  hinge.type = model::MotionType::kRevolute;
  hinge.parent = 0;
  hinge.child = 1;
  hinge.T_parent_joint = Eigen::Translation3d(-0.4, 0.0, 0.6);
  hinge.upper = 2.0;
  model.joints = {hinge};
  return model;
}

TEST(RenderView, WhatMovedLooksAsIfItHadAlwaysBeenThere) {
  const CameraRays rays(kCamera);
  Scene moved;
  moved.add(doorModel(), ahead(2.0), {0.0});
  moved.add(shared(model::makeSphere({})), ahead(4.0));
  moved.commit();
  const View before = renderView(moved, rays, {}, everything());
  moved.move(0, ahead(2.2), {1.1});
  moved.commit();
  Scene fresh;
  fresh.add(doorModel(), ahead(2.2), {1.1});
  fresh.add(shared(model::makeSphere({})), ahead(4.0));
  fresh.commit();
  const View after = renderView(moved, rays, {}, everything());
  EXPECT_TRUE(sameBytes(after, renderView(fresh, rays, {}, everything())));
  EXPECT_FALSE(sameBytes(after, before));
}

TEST(RenderView, ThePartImageNamesModelAndPart) {
  Scene scene;
  scene.add(shared(model::makeBox({4.0F, 4.0F, 0.1F})), ahead(5.0));
  scene.add(doorModel(), ahead(2.0), {0.0});
  scene.commit();
  ViewConfig config;
  config.with_parts = true;
  const View view = renderView(scene, CameraRays(kCamera), {}, config);
  const ScenePart& middle = scene.parts()[static_cast<std::size_t>(view.part.at<std::int32_t>(30, 40))];
  EXPECT_EQ(middle.model, 1);
  EXPECT_EQ(middle.part, 0);
  const ScenePart& behind = scene.parts()[static_cast<std::size_t>(view.part.at<std::int32_t>(5, 40))];
  EXPECT_EQ(behind.model, 0);
  EXPECT_EQ(view.part.at<std::int32_t>(0, 0), -1);
  EXPECT_TRUE(std::isnan(view.depth_m.at<float>(0, 0)));
}

TEST(RenderView, WhatIsNotShownIsNotThere) {
  Scene scene;
  scene.add(shared(model::makeBox({4.0F, 4.0F, 0.1F})), ahead(3.0));
  scene.add(shared(model::makeBox({1.0F, 1.0F, 0.1F})), ahead(2.0));
  scene.show(1, false);
  scene.commit();
  const CameraRays rays(kCamera);
  EXPECT_NEAR(renderView(scene, rays, {}, {}).depth_m.at<float>(30, 40), 2.95, 1e-5);
  scene.show(1, true);
  scene.commit();
  EXPECT_NEAR(renderView(scene, rays, {}, {}).depth_m.at<float>(30, 40), 1.95, 1e-5);
}

TEST(RenderView, TheSameBytesForAnyNumberOfThreads) {
  std::mt19937_64 random(3);
  Scene scene;
  for (int i = 0; i < 6; ++i) {
    scene.add(shared(randomMesh(random, 40)), ahead(2.5) * poseFrom(random, 0.4));
  }
  scene.add(doorModel(), ahead(2.0), {0.7});
  scene.commit();
  const CameraRays rays(kCamera, camera::LensDistortion{.k1 = 0.1});
  ViewConfig config = everything();
  const View one = renderView(scene, rays, {}, config);
  for (const int threads : {2, 3, 7}) {
    config.threads = threads;
    EXPECT_TRUE(sameBytes(renderView(scene, rays, {}, config), one)) << threads;
  }
}

TEST(RenderView, EachRowOfARollingShutterIsSeenFromItsOwnPose) {
  Scene scene;
  scene.add(shared(model::makeBox({9.0F, 9.0F, 1.0F})), ahead(3.0) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
  scene.commit();
  const CameraRays rays(kCamera);
  const Eigen::Isometry3d T_last = Eigen::Translation3d(0.3, 0.0, 0.1) * Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.0, 0.6, 0.8));
  const View rolling = renderView(scene, rays, {Eigen::Isometry3d::Identity(), T_last}, everything());
  const View first = renderView(scene, rays, {}, everything());
  const View last = renderView(scene, rays, {T_last, {}}, everything());
  const auto sameRow = [](const cv::Mat& a, const cv::Mat& b, int row) {
    return std::memcmp(a.ptr(row), b.ptr(row), static_cast<std::size_t>(a.cols) * a.elemSize()) == 0;
  };
  EXPECT_TRUE(sameRow(rolling.depth_m, first.depth_m, 0));
  const int middle = kCamera.height / 2;
  EXPECT_FALSE(sameRow(rolling.depth_m, first.depth_m, middle));
  EXPECT_FALSE(sameRow(rolling.depth_m, last.depth_m, middle));
  for (int u = 30; u < 50; ++u) {
    EXPECT_NEAR(rolling.depth_m.at<float>(kCamera.height - 1, u), last.depth_m.at<float>(kCamera.height - 1, u), 1e-6);
  }
}

}  // namespace
}  // namespace oikos::render
