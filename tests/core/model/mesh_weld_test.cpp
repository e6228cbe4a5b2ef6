// SPDX-License-Identifier: Apache-2.0
#include "core/model/mesh_weld.h"

#include <gtest/gtest.h>

#include "core/model/primitives.h"

namespace oikos::model {
namespace {

TEST(WeldVertices, CornersOfABoxAreSharedOnlyWhereAllIsTheSame) {
  TriangleMesh mesh = makeBox({1.0F, 2.0F, 3.0F});
  EXPECT_EQ(weldVertices(mesh).vertices.size(), 24U);
  mesh.normals.clear();
  mesh.texture_coordinates.clear();
  const TriangleMesh welded = weldVertices(mesh);
  EXPECT_EQ(welded.vertices.size(), 8U);
  ASSERT_EQ(welded.triangles.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(welded.areaNormal(i), mesh.areaNormal(i));
  }
  mesh.vertex_colors.assign(24, {0, 0, 0});
  mesh.vertex_colors[0] = {1, 0, 0};
  EXPECT_EQ(weldVertices(mesh).vertices.size(), 9U);
}

TEST(WeldVertices, MinusZeroIsZeroAndUnusedVerticesGo) {
  TriangleMesh mesh;
  mesh.vertices = {{9.0F, 9.0F, 9.0F}, {0.0F, 0.0F, 0.0F},   {1.0F, 0.0F, 0.0F},
                   {0.0F, 1.0F, 0.0F}, {-0.0F, 0.0F, -0.0F}, {0.0F, 0.0F, 1.0F}};
  mesh.triangles = {{1, 2, 3}, {4, 3, 5}};
  const TriangleMesh welded = weldVertices(mesh);
  EXPECT_EQ(welded.vertices.size(), 4U);
  EXPECT_EQ(welded.triangles[0], (TriangleMesh::Triangle{0, 1, 2}));
  EXPECT_EQ(welded.triangles[1], (TriangleMesh::Triangle{0, 2, 3}));
}

}  // namespace
}  // namespace oikos::model
