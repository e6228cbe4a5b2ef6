// SPDX-License-Identifier: Apache-2.0
#include "core/model/small_objects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/core/model/mesh_checks.h"

namespace oikos::model {
namespace {

using test::volumeM3;

constexpr double kPi = std::numbers::pi;
constexpr int kSides = 40;
const double kPolygon = kSides / 2.0 * std::sin(2.0 * kPi / kSides);  ///< area over that of the circle's radius squared

/// With diameters along x and y, standing on z = 0.
void expectStands(const TriangleMesh& mesh, const Eigen::Vector3f& size_m) {
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_EQ(test::openEdges(mesh), 0);
  EXPECT_EQ(test::wrongNormals(mesh, 0.8), 0);
  EXPECT_LT(mesh.triangles.size(), 3000U);
  EXPECT_EQ(mesh.texture_coordinates.size(), mesh.vertices.size());
  const Eigen::AlignedBox3f bounds = mesh.bounds();
  EXPECT_EQ(bounds.min().z(), 0.0F);
  EXPECT_TRUE(bounds.sizes().isApprox(size_m, 1e-5F)) << bounds.sizes().transpose();
  for (const Material& material : mesh.materials) {
    EXPECT_FALSE(material.name.empty());
  }
}

Eigen::AlignedBox2f imageOf(const TriangleMesh& mesh, const std::string& material) {
  Eigen::AlignedBox2f image;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (mesh.materialOf(i).name == material) {
        image.extend(mesh.texture_coordinates[vertex]);
      }
    }
  }
  return image;
}

void expectWholeImage(const TriangleMesh& mesh, const std::string& material) {
  const Eigen::AlignedBox2f image = imageOf(mesh, material);
  EXPECT_LT(image.min().norm(), 1e-6F) << material;
  EXPECT_LT((image.max() - Eigen::Vector2f::Ones()).norm(), 1e-6F) << material;
}

/// Of a cone's trunk over its polygon.
double trunkM3(double lower_m, double upper_m, double height_m) {
  return kPolygon * height_m / 3.0 * (lower_m * lower_m + lower_m * upper_m + upper_m * upper_m);
}

TEST(SmallObjects, ACupHoldsWhatItsInnerTrunkHolds) {
  const CupShape shape = {.diameter_m = 0.08, .bottom_diameter_m = 0.06, .height_m = 0.1, .handle_reach_m = 0.0};
  const TriangleMesh cup = makeCup(shape);
  expectStands(cup, {0.08F, 0.08F, 0.1F});
  const double inner_foot_m = 0.03 + 0.01 * 0.06 - 0.004;
  EXPECT_NEAR(volumeM3(cup), trunkM3(0.03, 0.04, 0.1) - trunkM3(inner_foot_m, 0.036, 0.1 - 0.006), 1e-9);
  expectWholeImage(cup, "outside");
}

TEST(SmallObjects, ACupsHandleReachesOutAtItsSideAndNotInside) {
  const CupShape shape;
  const TriangleMesh cup = makeCup(shape);
  EXPECT_TRUE(validate(cup).empty());
  EXPECT_EQ(test::openEdges(cup), 0);
  EXPECT_EQ(test::wrongNormals(cup, 0.8), 0);
  const Eigen::AlignedBox3f bounds = cup.bounds();
  const double middle_m = (shape.diameter_m + shape.bottom_diameter_m) / 4.0;
  EXPECT_NEAR(bounds.max().y(), middle_m + shape.handle_reach_m, 0.001);
  EXPECT_NEAR(bounds.min().y(), -shape.diameter_m / 2.0, 1e-7);
  const std::size_t first = makeCup({.handle_reach_m = 0.0}).vertices.size();
  ASSERT_LT(first, cup.vertices.size());
  for (std::size_t i = first; i < cup.vertices.size(); ++i) {
    const double share = cup.vertices[i].z() / shape.height_m;
    const double inner_m = (shape.bottom_diameter_m + share * (shape.diameter_m - shape.bottom_diameter_m)) / 2.0 - shape.wall_m;
    EXPECT_GT(cup.vertices[i].head<2>().norm(), inner_m);
  }
}

TEST(SmallObjects, BowlAndPlateAreAsWideAndHighAsTheyWereMeasured) {
  const TriangleMesh bowl = makeBowl({.diameter_m = 0.14, .height_m = 0.06});
  expectStands(bowl, {0.14F, 0.14F, 0.06F});
  const TriangleMesh plate = makePlate({.diameter_m = 0.26, .height_m = 0.02});
  expectStands(plate, {0.26F, 0.26F, 0.02F});
  EXPECT_GT(volumeM3(bowl), 0.0);
  // Two surfaces that differ by the wall's height everywhere but near the bend: a disc of the wall's thickness, bent.
  EXPECT_NEAR(volumeM3(plate), kPolygon * 0.13 * 0.13 * 0.005, 0.02 * kPolygon * 0.13 * 0.13 * 0.005);
  expectWholeImage(plate, "inside");
}

TEST(SmallObjects, LabelsCoverTheirMantlesOnce) {
  const TriangleMesh bottle = makeBottle({.diameter_m = 0.08, .height_m = 0.28});
  expectStands(bottle, {0.08F, 0.08F, 0.28F});
  expectWholeImage(bottle, "label");
  const TriangleMesh tin = makeTin({.diameter_m = 0.1, .height_m = 0.12});
  expectStands(tin, {0.1F, 0.1F, 0.12F});
  expectWholeImage(tin, "label");
  const double recesses = 2.0 * kPolygon * 0.003 * 0.047 * 0.047;
  const double groove = kPolygon * (0.05 * 0.05 - 0.049 * 0.049) * (0.12 - 0.006);
  EXPECT_NEAR(volumeM3(tin), kPolygon * 0.0025 * 0.12 - recesses - groove, 1e-9);
  const TriangleMesh jar = makeJar({.diameter_m = 0.1, .height_m = 0.13});
  expectStands(jar, {0.1F, 0.1F, 0.13F});
  expectWholeImage(jar, "label");
}

TEST(SmallObjects, ABoxShowsAWholeImageOnEachFaceByItsName) {
  const TriangleMesh box = makeSmallBox({.width_m = 0.2, .depth_m = 0.05, .height_m = 0.3});
  expectStands(box, {0.05F, 0.2F, 0.3F});
  EXPECT_NEAR(volumeM3(box), 0.2 * 0.05 * 0.3, 1e-9);
  const std::vector<std::pair<std::string, Eigen::Vector3d>> faces = {
      {"front", Eigen::Vector3d::UnitX()}, {"back", -Eigen::Vector3d::UnitX()},   {"right", Eigen::Vector3d::UnitY()},
      {"left", -Eigen::Vector3d::UnitY()}, {"bottom", -Eigen::Vector3d::UnitZ()}, {"top", Eigen::Vector3d::UnitZ()}};
  for (const auto& [name, normal] : faces) {
    expectWholeImage(box, name);
    for (std::size_t i = 0; i < box.triangles.size(); ++i) {
      EXPECT_EQ(box.materialOf(i).name == name, box.areaNormal(i).normalized().dot(normal) > 0.99);
    }
  }
}

TEST(SmallObjects, ACartonIsABoxBelowARoof) {
  const CartonShape shape = {
      .width_m = 0.07, .depth_m = 0.08, .height_m = 0.24, .roof_height_m = 0.03, .seam_m = 0.015, .cap_diameter_m = 0.0};
  const TriangleMesh carton = makeCarton(shape);
  expectStands(carton, {0.08F, 0.07F, 0.24F});
  const double seam = 0.07 * 0.03 * 0.08 * (0.015 + 0.03 * 0.03);
  EXPECT_NEAR(volumeM3(carton), 0.07 * 0.08 * (0.195 + 0.015) + seam, 1e-9);
  const TriangleMesh with_cap = makeCarton({});
  EXPECT_EQ(test::openEdges(with_cap), 0);
  expectWholeImage(with_cap, "front");
}

TEST(SmallObjects, ABookHasItsPagesWithinItsCovers) {
  const BookShape shape = {.width_m = 0.15, .depth_m = 0.03, .height_m = 0.22, .board_m = 0.003};
  const TriangleMesh book = makeBook(shape);
  expectStands(book, {0.03F, 0.15F, 0.22F});
  const double covers = 2.0 * 0.003 * 0.15 * 0.22 + 0.003 * 0.024 * 0.22;
  EXPECT_NEAR(volumeM3(book), covers + 0.024 * (0.15 - 0.006) * (0.22 - 0.006), 1e-8);
  for (const char* face : {"cover", "back_cover", "spine"}) {
    expectWholeImage(book, face);
  }
}

TEST(SmallObjects, SayWhatIsWrong) {
  EXPECT_EQ(CupShape{.diameter_m = 0.0}.validate().front(), "object.diameter_m = 0: must be > 0");
  EXPECT_EQ(CupShape{.wall_m = 0.05}.validate().front(), "object.wall_m = 0.05: must leave room inside");
  EXPECT_EQ(BottleShape{.neck_height_m = 0.1}.validate().front(), "object.neck_height_m = 0.1: must be > shoulder_height_m");
  EXPECT_EQ(TinShape{.rim_m = 0.05}.validate().front(), "object.rim_m = 0.05: must be less than a quarter of the tin");
  EXPECT_EQ(BookShape{.depth_m = 0.005}.validate().front(), "object.board_m = 0.0025: must leave room for the pages");
}

}  // namespace
}  // namespace oikos::model
