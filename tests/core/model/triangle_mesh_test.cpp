// SPDX-License-Identifier: Apache-2.0
#include "core/model/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/model/primitives.h"
#include "tests/core/model/mesh_checks.h"

namespace oikos::model {
namespace {

using test::volumeM3;

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
