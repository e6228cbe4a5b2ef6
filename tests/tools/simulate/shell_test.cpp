// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/shell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace oikos::simulate {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

const Outline kRectangle = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}, {0.0, 3.0}};                       // 12 m², 14 m around
const Outline kLShape = {{0.0, 0.0}, {5.0, 0.0}, {5.0, 2.0}, {2.0, 2.0}, {2.0, 4.0}, {0.0, 4.0}};  // 14 m², 18 m around
const Outline kUShape = {{0.0, 0.0}, {5.0, 0.0}, {5.0, 3.0}, {4.0, 3.0}, {4.0, 1.0},
                         {2.5, 1.0}, {1.0, 1.0}, {1.0, 3.0}, {0.0, 3.0}};  // 9 m²

Outline reversed(Outline outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

double perimeterOf(const Outline& outline) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum_m += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  }
  return sum_m;
}

double areaOf(const model::TriangleMesh& mesh, ShellMaterial material) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    sum += mesh.triangle_materials[i] == material ? 0.5 * mesh.areaNormal(i).norm() : 0.0;
  }
  return sum;
}

/// By the angle that the outline winds about it.
bool isInside(const Outline& outline, const Eigen::Vector2d& p) {
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d a = outline[i] - p;
    const Eigen::Vector2d b = outline[(i + 1) % outline.size()] - p;
    angle_rad += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(angle_rad) > std::numbers::pi;
}

Eigen::Vector3d middleOf(const model::TriangleMesh& mesh, std::size_t triangle) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    sum += mesh.vertices[vertex].cast<double>() / 3.0;
  }
  return sum;
}

RoomShell shellOf(const Outline& outline, std::vector<WallOpening> openings = {}) {
  RoomShell shell;
  shell.outline_map = outline;
  shell.openings = std::move(openings);
  return shell;
}

class Shells : public testing::TestWithParam<Outline> {};

TEST_P(Shells, HaveTheAreasOfThePolygon) {
  const model::TriangleMesh mesh = makeShell(shellOf(GetParam()));
  EXPECT_TRUE(validate(mesh).empty());
  const double area = GetParam().size() == 4 ? 12.0 : GetParam().size() == 6 ? 14.0 : 9.0;
  EXPECT_NEAR(areaOf(mesh, kFloorMaterial), area, 1e-5);
  EXPECT_NEAR(areaOf(mesh, kCeilingMaterial), area, 1e-5);
  EXPECT_NEAR(areaOf(mesh, kWallMaterial), perimeterOf(GetParam()) * 2.5, 1e-4);
  EXPECT_NEAR(areaOf(mesh, kSkirtingMaterial), perimeterOf(GetParam()) * 0.07, 1e-4);
}

TEST_P(Shells, FaceInwards) {
  const model::TriangleMesh mesh = makeShell(shellOf(GetParam()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3d before_it = middleOf(mesh, i) + 0.01 * mesh.areaNormal(i).normalized();
    EXPECT_TRUE(isInside(GetParam(), before_it.head<2>())) << i;
    EXPECT_GT(before_it.z(), 0.005) << i;
    EXPECT_LT(before_it.z(), 2.495) << i;
  }
}

TEST_P(Shells, TexturesAreInMetres) {
  const model::TriangleMesh mesh = makeShell(shellOf(GetParam()));
  ASSERT_EQ(mesh.texture_coordinates.size(), mesh.vertices.size());
  for (const model::TriangleMesh::Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[static_cast<std::size_t>(i)];
      const std::uint32_t b = t[static_cast<std::size_t>((i + 1) % 3)];
      EXPECT_NEAR((mesh.texture_coordinates[a] - mesh.texture_coordinates[b]).norm(), (mesh.vertices[a] - mesh.vertices[b]).norm(), 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EitherWayRound, Shells,
                         testing::Values(kRectangle, reversed(kRectangle), kLShape, reversed(kLShape), kUShape, reversed(kUShape)));

/// A door of 0.9 m × 2 m in the wall y = 0, its line 0.06 m behind the wall.
WallOpening doorOf(double x_m) {
  WallOpening opening;
  opening.from_map = {x_m - 0.45, -0.06};
  opening.to_map = {x_m + 0.45, -0.06};
  opening.height_m = 2.0;
  return opening;
}

TEST(Shell, AnOpeningIsCutFromOneWallOnly) {
  const model::TriangleMesh mesh = makeShell(shellOf(kLShape, {doorOf(3.0)}));
  EXPECT_NEAR(areaOf(mesh, kWallMaterial), 18.0 * 2.5 - 0.9 * 2.0, 1e-4);
  EXPECT_NEAR(areaOf(mesh, kSkirtingMaterial), (18.0 - 0.9) * 0.07, 1e-4);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_materials[i] != kWallMaterial) {
      continue;
    }
    const Eigen::Vector3d middle = middleOf(mesh, i);
    const bool is_in_door = std::abs(middle.y()) < 0.01 && std::abs(middle.x() - 3.0) < 0.44 && middle.z() < 2.0;
    EXPECT_FALSE(is_in_door);
  }
}

TEST(Shell, OpeningsInTwoDirectionsAndInARow) {
  EXPECT_NEAR(areaOf(makeShell(shellOf(kRectangle, {doorOf(3.0), doorOf(1.0)})), kWallMaterial), 14.0 * 2.5 - 2.0 * 0.9 * 2.0, 1e-4);
  // Two that overlap by 0.4 m, written the other way about.
  WallOpening second = doorOf(1.5);
  std::swap(second.from_map, second.to_map);
  EXPECT_NEAR(areaOf(makeShell(shellOf(kRectangle, {doorOf(1.0), second})), kWallMaterial), 14.0 * 2.5 - 1.4 * 2.0, 1e-4);
}

TEST(Shell, OpeningsOfOtherRoomsAreNotItsOwn) {
  WallOpening far = doorOf(2.0);
  far.from_map.y() = far.to_map.y() = -0.4;
  WallOpening beyond = doorOf(9.0);
  WallOpening across = doorOf(2.0);  // a door in a wall that meets this one at right angles
  across.from_map = {2.0, -0.2};
  across.to_map = {2.0, -1.1};
  EXPECT_NEAR(areaOf(makeShell(shellOf(kRectangle, {far, beyond, across})), kWallMaterial), 14.0 * 2.5, 1e-4);
}

TEST(Shell, AnOpeningUpToTheCeilingLeavesNothingAbove) {
  WallOpening opening = doorOf(2.0);
  opening.height_m = 3.0;
  const model::TriangleMesh mesh = makeShell(shellOf(kRectangle, {opening}));
  EXPECT_NEAR(areaOf(mesh, kWallMaterial), (14.0 - 0.9) * 2.5, 1e-4);
  EXPECT_LE(mesh.bounds().max().z(), 2.5F);
}

TEST(Threshold, IsAPieceOfFloor) {
  const model::TriangleMesh mesh = makeThreshold(doorOf(1.0));
  EXPECT_NEAR(areaOf(mesh, kFloorMaterial), 0.9 * 0.16, 1e-6);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    EXPECT_GT(mesh.areaNormal(i).z(), 0.0);
  }
}

}  // namespace
}  // namespace oikos::simulate
