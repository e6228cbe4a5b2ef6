// SPDX-License-Identifier: Apache-2.0
#include "core/model/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/primitives.h"

namespace oikos::model {
namespace {

/// By the divergence theorem; positive only if the triangles are counter-clockwise seen from outside.
double volumeM3(const TriangleMesh& mesh) {
  double volume_m3 = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    volume_m3 += mesh.vertices[mesh.triangles[i][0]].cast<double>().dot(mesh.areaNormal(i)) / 6.0;
  }
  return volume_m3;
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

TEST(TriangleMesh, NormalsAreThoseOfTheTriangles) {
  for (const TriangleMesh& mesh : {makeBox({1.0F, 2.0F, 3.0F}), withFlatNormals(makeSphere({.radius_m = 1.0F, .rings = 5}))}) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      EXPECT_NEAR((mesh.areaNormal(i).normalized() - mesh.normals[mesh.triangles[i][1]].cast<double>()).norm(), 0.0, 1e-6);
    }
  }
}

TEST(TriangleMesh, AppendingMovesAndKeepsMaterials) {
  TriangleMesh mesh = makeBox({1.0F, 1.0F, 1.0F});
  TriangleMesh red = makeBox({1.0F, 1.0F, 1.0F});
  red.normals.clear();
  red.materials = {{.name = "red", .color_rgb = {1.0F, 0.0F, 0.0F}, .texture = {}}};
  Eigen::Isometry3d T_mesh_other = Eigen::Isometry3d::Identity();
  T_mesh_other.translation().x() = 5.0;
  append(mesh, red, T_mesh_other);
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_NEAR(volumeM3(mesh), 2.0, 1e-6);
  EXPECT_FLOAT_EQ(mesh.bounds().max().x(), 5.5F);
  EXPECT_EQ(mesh.materialOf(0).name, "");
  EXPECT_EQ(mesh.materialOf(12).name, "red");
}

TEST(TriangleMesh, ValidationNamesEachProblem) {
  TriangleMesh mesh = makeBox({1.0F, 1.0F, 1.0F});
  mesh.normals.pop_back();
  mesh.vertices[3].x() = std::nanf("");
  mesh.triangles[1][2] = 99;
  mesh.triangle_materials.assign(12, 1);
  EXPECT_EQ(validate(mesh).size(), 4U);
}

}  // namespace
}  // namespace oikos::model
