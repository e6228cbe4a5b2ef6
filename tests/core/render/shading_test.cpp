// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/tone_curve.h"
#include "core/model/primitives.h"
#include "core/render/view.h"

namespace oikos::render {
namespace {

const camera::PinholeCamera kCamera{.width = 64, .height = 48, .fx = 60.0, .fy = 60.0, .cx = 31.5, .cy = 23.5};

/// A square in the plane z = 0 that faces -z, 2 m wide; as a camera sees it that looks along z, its texture is upright.
model::TriangleMesh makeScreen(const model::Material& material) {
  model::TriangleMesh mesh;
  mesh.vertices = {{-1.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 0.0F}, {1.0F, -1.0F, 0.0F}, {-1.0F, -1.0F, 0.0F}};  // y is down
  mesh.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.materials = {material};
  return mesh;
}

Scene sceneOf(const model::TriangleMesh& mesh, double distance_m) {
  Scene scene;
  scene.add(std::make_shared<const model::TriangleMesh>(mesh), Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, distance_m)));
  return scene;
}

float linearOf(std::uint8_t byte) {
  return geometry::ToneCurve::instance().toLight(byte);
}

ViewConfig colored(const Lighting& lighting) {
  ViewConfig config;
  config.with_color = true;
  config.lighting = lighting;
  return config;
}

Lighting evenLight() {
  Lighting lighting;
  lighting.from_above_rgb = lighting.from_below_rgb = Eigen::Vector3f::Ones();
  return lighting;
}

model::Material white() {
  model::Material material;
  material.color_rgb.setOnes();
  return material;
}

TEST(Shading, ATextureStandsUpright) {
  model::Material material = white();
  material.texture = cv::Mat(64, 64, CV_8UC3);
  material.texture(cv::Rect(0, 0, 32, 32)) = cv::Scalar(255, 0, 0);
  material.texture(cv::Rect(32, 0, 32, 32)) = cv::Scalar(0, 255, 0);
  material.texture(cv::Rect(0, 32, 32, 32)) = cv::Scalar(0, 0, 255);
  material.texture(cv::Rect(32, 32, 32, 32)) = cv::Scalar(9, 9, 9);
  Scene scene = sceneOf(makeScreen(material), 2.5);  // 48 pixels wide, all of the picture's height
  scene.commit();
  const cv::Mat color = renderView(scene, CameraRays(kCamera), {}, colored(evenLight())).color;
  EXPECT_EQ(color.at<cv::Vec3b>(12, 20), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(color.at<cv::Vec3b>(12, 43), cv::Vec3b(0, 255, 0));
  EXPECT_EQ(color.at<cv::Vec3b>(35, 20), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(color.at<cv::Vec3b>(35, 43), cv::Vec3b(9, 9, 9));
  EXPECT_EQ(color.at<cv::Vec3b>(24, 2), cv::Vec3b(0, 0, 0));  // beside it
}

TEST(Shading, FineTextureFarAwayIsTheMeanOfItsLight) {
  model::Material material = white();
  material.texture = cv::Mat(256, 256, CV_8UC3);
  for (int v = 0; v < 256; ++v) {
    for (int u = 0; u < 256; ++u) {
      material.texture.at<cv::Vec3b>(v, u) = (u + v) % 2 == 0 ? cv::Vec3b(255, 255, 255) : cv::Vec3b(0, 0, 0);
    }
  }
  Scene scene = sceneOf(makeScreen(material), 2.6);
  scene.commit();
  const cv::Mat color = renderView(scene, CameraRays(kCamera), {}, colored(evenLight())).color;
  for (int u = 16; u < 48; ++u) {
    EXPECT_NEAR(linearOf(color.at<cv::Vec3b>(20, u)[0]), 0.5, 0.01);
  }
}

TEST(Shading, ALampLightsByCosineAndSquareOfTheDistance) {
  Scene scene = sceneOf(makeScreen(white()), 3.0);
  scene.commit();
  Lighting lighting;
  lighting.from_above_rgb.setZero();
  lighting.from_below_rgb.setZero();
  lighting.lamps = {{Eigen::Vector3d(0.5, -0.3, 1.0), Eigen::Vector3f(1.6F, 0.8F, 0.4F)}};
  const cv::Mat color = renderView(scene, CameraRays(kCamera), {}, colored(lighting)).color;
  for (const cv::Point pixel : {cv::Point(20, 10), cv::Point(31, 23), cv::Point(45, 38)}) {
    const Eigen::Vector3d to_lamp = lighting.lamps[0].position_map - 3.0 * kCamera.ray(pixel.x, pixel.y);
    const double light = -to_lamp.normalized().z() / to_lamp.squaredNorm();
    const cv::Vec3b seen = color.at<cv::Vec3b>(pixel);
    EXPECT_NEAR(linearOf(seen[2]), 1.6 * light, 0.006);
    EXPECT_NEAR(linearOf(seen[1]), 0.8 * light, 0.006);
    EXPECT_NEAR(linearOf(seen[0]), 0.4 * light, 0.006);
  }
}

TEST(Shading, WhatStandsBeforeALampThrowsItsShadow) {
  Scene scene = sceneOf(makeScreen(white()), 3.0);
  const Eigen::Vector3d lamp_map(0.0, -2.5, 1.0);
  // A small box half way between the lamp and the point (0, 0.2, 3) of the screen, out of the camera's sight line to it.
  const Eigen::Vector3d shaded_map(0.0, 0.2, 3.0);
  const Eigen::Isometry3d T_map_box(Eigen::Translation3d(0.5 * (lamp_map + shaded_map)));
  scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox({0.1F, 0.1F, 0.1F})), T_map_box);
  scene.commit();
  Lighting lighting;
  lighting.from_above_rgb = lighting.from_below_rgb = Eigen::Vector3f::Constant(0.1F);
  lighting.lamps = {{lamp_map, Eigen::Vector3f::Constant(5.0F)}};
  const Eigen::Vector2d pixel = kCamera.project(shaded_map);
  const cv::Point shaded(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  const CameraRays rays(kCamera);
  EXPECT_NEAR(linearOf(renderView(scene, rays, {}, colored(lighting)).color.at<cv::Vec3b>(shaded)[0]), 0.1, 0.004);
  EXPECT_GT(linearOf(renderView(scene, rays, {}, colored(lighting)).color.at<cv::Vec3b>(shaded.y, shaded.x + 12)[0]), 0.3);
  lighting.has_shadows = false;
  EXPECT_GT(linearOf(renderView(scene, rays, {}, colored(lighting)).color.at<cv::Vec3b>(shaded)[0]), 0.3);
}

/// Whether a straight way from a to b goes through a box.
bool isBlocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::AlignedBox3d& box) {
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = (box.min()[axis] - a[axis]) / (b[axis] - a[axis]);
    const double second = (box.max()[axis] - a[axis]) / (b[axis] - a[axis]);
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter < leave;
}

/// Bars of many widths before a lamp: what is rendered with few rays is what each pixel's own ray finds.
TEST(Shading, ShadowsOfBarsLieWhereGeometryPutsThem) {
  const camera::PinholeCamera camera{.width = 320, .height = 240, .fx = 300.0, .fy = 300.0, .cx = 159.5, .cy = 119.5};
  Scene scene = sceneOf(makeScreen(white()), 3.0);
  const Eigen::Vector3d lamp_map(0.11, -2.3, 1.07);
  std::vector<Eigen::AlignedBox3d> bars;
  for (int i = 0; i < 6; ++i) {
    const double width_m = 0.008 * (i + 1);
    const Eigen::Vector3d middle_map(-0.35 + 0.13 * i, -1.63, 2.0);  // above what the camera sees
    const Eigen::Vector3d half(0.5 * width_m, 0.3, 0.01);
    bars.emplace_back(middle_map - half, middle_map + half);
    scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox((2.0 * half).cast<float>())),
              Eigen::Isometry3d(Eigen::Translation3d(middle_map)));
  }
  scene.commit();
  Lighting lighting;
  lighting.from_above_rgb.setZero();
  lighting.from_below_rgb.setZero();
  lighting.lamps = {{lamp_map, Eigen::Vector3f::Constant(5.0F)}};
  const View view = renderView(scene, CameraRays(camera), {}, colored(lighting));
  const auto isShaded = [&](double u, double v) {
    return std::any_of(bars.begin(), bars.end(), [&](const auto& bar) { return isBlocked(3.0 * camera.ray(u, v), lamp_map, bar); });
  };
  int shaded = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const bool here = isShaded(u, v);
      const bool is_border =
          isShaded(u - 0.1, v) != here || isShaded(u + 0.1, v) != here || isShaded(u, v - 0.1) != here || isShaded(u, v + 0.1) != here;
      const double x = 3.0 * camera.ray(u, v).x();
      const double y = 3.0 * camera.ray(u, v).y();
      if (std::max(std::abs(x), std::abs(y)) < 0.98 && !is_border) {
        ASSERT_EQ(view.color.at<cv::Vec3b>(v, u)[0] == 0, here) << "pixel " << u << " " << v;
        shaded += here ? 1 : 0;
      }
    }
  }
  EXPECT_GT(shaded, 2000);
}

TEST(Shading, GlossMirrorsALampOnlyInItsDirection) {
  model::Material black = white();
  black.color_rgb.setZero();
  black.gloss = 1.0F;
  Scene scene = sceneOf(makeScreen(black), 3.0);
  scene.commit();
  Lighting lighting;
  lighting.lamps = {{Eigen::Vector3d(0.0, 0.0, 0.5), Eigen::Vector3f::Constant(4.0F)}};
  const cv::Mat color = renderView(scene, CameraRays(kCamera), {}, colored(lighting)).color;
  EXPECT_GT(color.at<cv::Vec3b>(24, 32)[0], 200);
  EXPECT_LT(color.at<cv::Vec3b>(8, 14)[0], 40);
}

TEST(Shading, EdgesAreMixed) {
  Scene scene = sceneOf(makeScreen(white()), 3.0);  // from column 11.5 to 51.5
  scene.commit();
  const cv::Mat color = renderView(scene, CameraRays(kCamera), {}, colored(evenLight())).color;
  EXPECT_EQ(color.at<cv::Vec3b>(24, 10)[0], 0);
  EXPECT_EQ(color.at<cv::Vec3b>(24, 13)[0], 255);
  Scene between = sceneOf(makeScreen(white()), 60.0 / 19.75);  // its left edge in the middle of pixel 11.75
  between.commit();
  const cv::Mat mixed = renderView(between, CameraRays(kCamera), {}, colored(evenLight())).color;
  EXPECT_NEAR(linearOf(mixed.at<cv::Vec3b>(24, 12)[0]), 0.75, 0.01);
}

}  // namespace
}  // namespace oikos::render
