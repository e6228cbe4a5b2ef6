// SPDX-License-Identifier: Apache-2.0
#include "core/model/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/revolved.h"
#include "tests/core/model/mesh_checks.h"

namespace oikos::model {
namespace {

using test::openEdges;
using test::volumeM3;
using test::wrongNormals;

constexpr double kPi = std::numbers::pi;

/// A prism's base over a circle's: area of the polygon with this many corners on the circle of radius 1.
double polygonArea(int corners) {
  return corners / 2.0 * std::sin(2.0 * kPi / corners);
}

void expectClosed(const TriangleMesh& mesh, double min_cosine) {
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_EQ(mesh.texture_coordinates.size(), mesh.vertices.size());
  EXPECT_EQ(openEdges(mesh), 0);
  EXPECT_EQ(wrongNormals(mesh, min_cosine), 0);
}

/// Texture units per metre along the surface, from a triangle's edges: singular values of d(u, v) / d(place).
Eigen::Vector2d textureScales(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d right = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
  const Eigen::Vector3d other = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
  const Eigen::Vector3d x = right.normalized();
  const Eigen::Vector3d y = mesh.areaNormal(triangle).normalized().cross(x);
  Eigen::Matrix2d places;
  places << right.dot(x), other.dot(x), right.dot(y), other.dot(y);
  Eigen::Matrix2d units;
  units << (mesh.texture_coordinates[b] - mesh.texture_coordinates[a]).cast<double>(),
      (mesh.texture_coordinates[c] - mesh.texture_coordinates[a]).cast<double>();
  const Eigen::Matrix2d scale = units * places.inverse();
  EXPECT_GT(scale.determinant(), 0.0) << "a mirrored image on triangle " << triangle;
  return scale.jacobiSvd().singularValues();
}

TEST(Primitives, ABoxHasItsVolumeAndBounds) {
  const TriangleMesh box = makeBox({1.0F, 2.0F, 3.0F});
  EXPECT_TRUE(validate(box).empty());
  EXPECT_EQ(box.triangles.size(), 12U);
  EXPECT_NEAR(volumeM3(box), 6.0, 1e-9);
  EXPECT_TRUE(box.bounds().min().isApprox(Eigen::Vector3f(-0.5F, -1.0F, -1.5F)));
  EXPECT_TRUE(box.bounds().max().isApprox(Eigen::Vector3f(0.5F, 1.0F, 1.5F)));
}

TEST(Primitives, ACylinderHasTheVolumeOfItsPrism) {
  const TriangleMesh cylinder = makeCylinder({.radius_m = 0.5F, .length_m = 2.0F, .segments = 12});
  EXPECT_TRUE(validate(cylinder).empty());
  EXPECT_NEAR(volumeM3(cylinder), 2.0 * 6.0 * 0.25 * std::sin(std::numbers::pi / 6.0), 1e-6);
}

TEST(Primitives, ASphereIsInsideTheTrueOneByItsChords) {
  const TriangleMesh sphere = makeSphere({.radius_m = 1.0F, .rings = 40});
  EXPECT_TRUE(validate(sphere).empty());
  const double true_m3 = 4.0 / 3.0 * std::numbers::pi;
  EXPECT_LT(volumeM3(sphere), true_m3);
  EXPECT_GT(volumeM3(sphere), true_m3 * std::pow(std::cos(std::numbers::pi / 40.0), 3.0));
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i) {
    EXPECT_NEAR((sphere.vertices[i] - sphere.normals[i]).norm(), 0.0F, 1e-6F);
  }
}

TEST(Primitives, ABoxStandsExactlyOnItsBounds) {
  const Eigen::AlignedBox3f bounds(Eigen::Vector3f(0.1F, -0.7F, 0.3F), Eigen::Vector3f(0.4F, 0.2F, 1.9F));
  const TriangleMesh box = makeBoxBetween(bounds);
  expectClosed(box, 1.0 - 1e-6);
  EXPECT_EQ(box.bounds().min(), bounds.min());
  EXPECT_EQ(box.bounds().max(), bounds.max());
  EXPECT_NEAR(volumeM3(box), 0.3 * 0.9 * 1.6, 1e-6);
}

TEST(Primitives, ABoxHasMetresOrWholeImagesOnItsFaces) {
  const TriangleMesh metres = makeBox({0.5F, 2.0F, 3.0F});
  const TriangleMesh whole = makeBox({0.5F, 2.0F, 3.0F}, TextureScale::kWhole);
  for (std::size_t i = 0; i < metres.triangles.size(); ++i) {
    EXPECT_TRUE(textureScales(metres, i).isApprox(Eigen::Vector2d::Ones(), 1e-5));
  }
  for (std::size_t face = 0; face < 6; ++face) {
    Eigen::AlignedBox2f image;
    for (std::size_t i = 0; i < 4; ++i) {
      image.extend(whole.texture_coordinates[4 * face + i]);
    }
    EXPECT_EQ(image.min(), Eigen::Vector2f::Zero());
    EXPECT_EQ(image.max(), Eigen::Vector2f::Ones());
  }
}

TEST(Primitives, ImagesStandUprightOnABoxsSides) {
  const TriangleMesh box = makeBox({0.5F, 2.0F, 3.0F}, TextureScale::kWhole);
  for (std::size_t i = 0; i < box.vertices.size(); ++i) {
    if (box.normals[i].z() == 0.0F) {
      EXPECT_EQ(box.texture_coordinates[i].y(), box.vertices[i].z() > 0.0F ? 1.0F : 0.0F);
    }
    if (box.normals[i].x() == 1.0F) {
      EXPECT_EQ(box.texture_coordinates[i].x(), box.vertices[i].y() > 0.0F ? 1.0F : 0.0F);
    }
  }
}

TEST(Primitives, RoundShapesAreClosedWithTheVolumeOfTheirPolygons) {
  const TriangleMesh cylinder = makeCylinder({.radius_m = 0.5F, .length_m = 2.0F, .segments = 24});
  expectClosed(cylinder, std::cos(kPi / 24.0) - 1e-6);
  EXPECT_NEAR(volumeM3(cylinder), 2.0 * 0.25 * polygonArea(24), 1e-6);
  const TriangleMesh cone = makeTaperedCylinder({.bottom_radius_m = 0.3F, .top_radius_m = 0.1F, .height_m = 0.6F, .segments = 24});
  expectClosed(cone, std::cos(kPi / 24.0) - 1e-6);
  EXPECT_NEAR(volumeM3(cone), 0.6 / 3.0 * (0.09 + 0.03 + 0.01) * polygonArea(24), 1e-6);
  const TriangleMesh tube = makeTube({.bottom_radius_m = 0.3F, .top_radius_m = 0.3F, .height_m = 0.5F, .wall_m = 0.1F, .segments = 24});
  expectClosed(tube, std::cos(kPi / 24.0) - 1e-6);
  EXPECT_NEAR(volumeM3(tube), 0.5 * (0.09 - 0.04) * polygonArea(24), 1e-6);
  expectClosed(makeSphere({.radius_m = 0.2F, .rings = 16}), std::cos(kPi / 16.0));
}

TEST(Primitives, ALabelWrapsOnceAroundAMantleWithItsMiddleInFront) {
  const TriangleMesh whole = makeTaperedCylinder({.height_m = 0.6F, .segments = 24}, TextureScale::kWhole);
  for (std::size_t i = 0; i < whole.vertices.size(); ++i) {
    const Eigen::Vector2f& image = whole.texture_coordinates[i];
    EXPECT_TRUE(Eigen::AlignedBox2f(Eigen::Vector2f::Constant(-1e-6F), Eigen::Vector2f::Constant(1.0F + 1e-6F)).contains(image));
    if (std::fabs(whole.normals[i].z()) > 0.99F) {
      continue;
    }
    const double angle_rad = (static_cast<double>(image.x()) - 0.5) * 2.0 * kPi;
    const double radius_m = whole.vertices[i].head<2>().norm();
    EXPECT_NEAR(whole.vertices[i].x(), radius_m * std::cos(angle_rad), 1e-5);
    EXPECT_NEAR(whole.vertices[i].y(), radius_m * std::sin(angle_rad), 1e-5);
    EXPECT_NEAR(image.y(), whole.vertices[i].z() / 0.6, 1e-6);
  }
}

TEST(Primitives, ACylindersTextureIsInMetres) {
  const TriangleMesh cylinder = makeCylinder({.radius_m = 0.4F, .length_m = 1.0F, .segments = 96});
  for (std::size_t i = 0; i < cylinder.triangles.size(); ++i) {
    EXPECT_TRUE(textureScales(cylinder, i).isApprox(Eigen::Vector2d::Ones(), 1e-3));
  }
}

TEST(Primitives, ARoundedBoxLiesBetweenItsBoxAndTheTrueShape) {
  const RoundedBoxShape shape = {.size_m = {0.6F, 0.9F, 0.3F}, .radius_m = 0.1F, .steps = 6};
  const TriangleMesh mesh = makeRoundedBox(shape);
  expectClosed(mesh, std::cos(kPi / 12.0));
  EXPECT_TRUE(mesh.bounds().sizes().isApprox(shape.size_m, 1e-6F));
  const Eigen::Vector3d core(0.4, 0.7, 0.1);
  const double faces = 2.0 * 0.1 * (core.x() * core.y() + core.y() * core.z() + core.z() * core.x());
  const double edges = kPi * 0.01 * core.sum();
  const double true_m3 = core.prod() + faces + edges + 4.0 / 3.0 * kPi * 0.001;
  EXPECT_LT(volumeM3(mesh), true_m3);
  EXPECT_GT(volumeM3(mesh), true_m3 - (edges + 4.0 / 3.0 * kPi * 0.001) * (1.0 - std::pow(std::cos(kPi / 24.0), 3.0)));
}

TEST(Primitives, ABentRodHasTheVolumeThatPappusGives) {
  const TriangleMesh rod =
      makeBentRod({.arc_radius_m = 0.3F, .rod_radius_m = 0.05F, .from_rad = -1.0F, .to_rad = 2.0F, .segments = 200, .sides = 24});
  expectClosed(rod, std::cos(kPi / 24.0) - 1e-4);
  EXPECT_NEAR(volumeM3(rod), 3.0 * 0.3 * 0.0025 * polygonArea(24), 1e-6);
}

}  // namespace
}  // namespace oikos::model
