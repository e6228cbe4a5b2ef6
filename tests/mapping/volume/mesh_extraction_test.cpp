// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/mesh_extraction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <opencv2/core.hpp>

#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

TsdfVolume fuseRoom(int threads) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const camera::PinholeCamera camera{320, 240, 260.0, 260.0, 159.5, 119.5};
  TsdfVolume volume(TsdfConfig{}, threads);
  for (const Eigen::Isometry3d& T_map_camera : test::lookAround(12, 0.3, 1.3, 0.5)) {
    const camera::RgbdFrame frame = room.render(camera, T_map_camera);
    volume.integrate({frame, camera, T_map_camera});
  }
  return volume;
}

double areaM2(const geometry::ColoredMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto& points = mesh.vertices.points;
  const Eigen::Vector3f normal = (points[triangle[1]] - points[triangle[0]]).cross(points[triangle[2]] - points[triangle[0]]);
  return 0.5 * static_cast<double>(normal.norm());
}

TEST(MeshExtraction, LiesOnTheRoomsSurfaces) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  geometry::ColoredMesh mesh = extractMesh(fuseRoom(1), 1);
  removeSpecks(100, mesh);
  ASSERT_GT(mesh.vertices.points.size(), 20000U);
  double sum_m = 0.0;
  std::size_t far = 0;
  for (const Eigen::Vector3f& point : mesh.vertices.points) {
    const double distance_m = room.distanceToSurface(point.cast<double>());
    sum_m += distance_m;
    far += distance_m > 0.02 ? 1 : 0;
  }
  // Nearest pixels of 4 mm a metre under slant, and edges of one voxel's roundness.
  EXPECT_LT(sum_m / static_cast<double>(mesh.vertices.points.size()), 0.003);
  EXPECT_LT(static_cast<double>(far) / static_cast<double>(mesh.vertices.points.size()), 0.02);
}

TEST(MeshExtraction, TrianglesFaceFreeSpace) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const geometry::ColoredMesh mesh = extractMesh(fuseRoom(1), 1);
  double outwards_m2 = 0.0;
  double all_m2 = 0.0;
  const auto& points = mesh.vertices.points;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3f a = points[triangle[0]];
    const Eigen::Vector3f normal = (points[triangle[1]] - a).cross(points[triangle[2]] - a);
    const Eigen::Vector3f to_camera = Eigen::Vector3f(0.0F, 0.0F, 1.3F) - a;
    all_m2 += areaM2(mesh, triangle);
    outwards_m2 += normal.dot(to_camera) > 0.0F ? areaM2(mesh, triangle) : 0.0;
  }
  EXPECT_GT(outwards_m2 / all_m2, 0.98);
}

TEST(MeshExtraction, HasTheRoomsColours) {
  const geometry::ColoredMesh mesh = extractMesh(fuseRoom(1), 1);
  int table = 0;
  int table_red = 0;
  int floor = 0;
  int floor_brown = 0;
  for (std::size_t i = 0; i < mesh.vertices.points.size(); ++i) {
    const Eigen::Vector3f point = mesh.vertices.points[i];
    const geometry::Rgb color = mesh.vertices.colors[i];
    if (std::fabs(point.z() - 0.75F) < 0.01F && point.x() > 0.7F && point.x() < 1.3F && std::fabs(point.y()) < 0.7F) {
      ++table;
      table_red += color == geometry::Rgb{220, 30, 30} ? 1 : 0;
    }
    if (std::fabs(point.z()) < 0.01F && point.x() < 0.4F && point.x() > -1.9F && point.y() > -1.4F && point.y() < 0.5F) {
      ++floor;
      floor_brown += color == geometry::Rgb{120, 80, 40} ? 1 : 0;
    }
  }
  ASSERT_GT(table, 500);
  ASSERT_GT(floor, 500);
  EXPECT_GT(table_red, 0.98 * table);
  EXPECT_GT(floor_brown, 0.98 * floor);
}

TEST(MeshExtraction, VerticesAreShared) {
  const geometry::ColoredMesh mesh = extractMesh(fuseRoom(1), 1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      ++edges[{low, high}];
    }
  }
  std::size_t inner = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_LE(count, 2);
    inner += count == 2 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(inner) / static_cast<double>(edges.size()), 0.9);
}

TEST(MeshExtraction, SameBytesForAnyNumberOfThreads) {
  const geometry::ColoredMesh one = extractMesh(fuseRoom(1), 1);
  for (const int threads : {2, 5}) {
    const geometry::ColoredMesh many = extractMesh(fuseRoom(threads), threads);
    EXPECT_EQ(many.vertices.points, one.vertices.points);
    EXPECT_EQ(many.vertices.colors, one.vertices.colors);
    EXPECT_EQ(many.triangles, one.triangles);
  }
}

TEST(MeshExtraction, NothingInNothingOut) {
  const TsdfVolume volume(TsdfConfig{}, 1);
  EXPECT_TRUE(extractMesh(volume, 2).triangles.empty());
}

TEST(RemoveSpecks, TakesSmallPiecesAndTheirVertices) {
  geometry::ColoredMesh mesh;
  mesh.vertices.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {1, 1, 0}};
  mesh.vertices.colors.resize(8);
  mesh.vertices.colors[7] = {1, 2, 3};
  mesh.triangles = {{1, 2, 3}, {4, 5, 6}, {2, 7, 3}};
  removeSpecks(2, mesh);
  const std::vector<std::array<std::uint32_t, 3>> expected = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_EQ(mesh.triangles, expected);
  ASSERT_EQ(mesh.vertices.points.size(), 4U);
  EXPECT_EQ(mesh.vertices.points[3], Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(mesh.vertices.colors[3], (geometry::Rgb{1, 2, 3}));
}

}  // namespace
}  // namespace oikos::mapping
