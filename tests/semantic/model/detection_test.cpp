// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/detection.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "semantic/model/placement.h"
#include "semantic/xml/home_reader.h"
#include "tests/semantic/papers_house.h"

namespace oikos::semantic {
namespace {

Home demoHome() {
  return readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/household/home.xml").home;
}

Eigen::Isometry3d inMap(const LargeObject& object, const SmallObject& small) {
  return findCarrierInMap(object, small.parent).value() * small.T_parent_object.toIsometry();
}

TEST(Marker, LiesOnTheOpticalAxis) {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.translation() = Eigen::Vector3d(1.0, 2.0, 1.1);
  T_map_camera.linear().col(0) = -Eigen::Vector3d::UnitY();
  T_map_camera.linear().col(1) = -Eigen::Vector3d::UnitZ();
  T_map_camera.linear().col(2) = Eigen::Vector3d::UnitX();
  EXPECT_LT((markerInMap(T_map_camera, 2.5) - Eigen::Vector3d(3.5, 2.0, 1.1)).norm(), 1e-12);
}

TEST(FindPlacement, EverySmallObjectOfTheDemoApartmentIsWhereItsHomeSaysItIs) {
  const Home home = demoHome();
  int looked_at = 0;
  for (const Room& room : home.rooms) {
    for (const LargeObject& object : room.objects) {
      for (const SmallObject& small : object.small_objects) {
        const auto found = findPlacement(home, inMap(object, small), small.box_model);
        ASSERT_TRUE(found) << small.id.value;
        EXPECT_EQ(found->parent, small.parent) << small.id.value;
        EXPECT_EQ(found->relation, small.relation) << small.id.value;
        EXPECT_LT((found->T_parent_object.position_m - small.T_parent_object.position_m).norm(), 1e-9) << small.id.value;
        ++looked_at;
      }
    }
  }
  EXPECT_GT(looked_at, 30);
}

TEST(FindPlacement, ADrawerCarriesWhatIsInItWhereItStandsOpen) {
  Home home = demoHome();
  for (Room& room : home.rooms) {
    for (auto& shared : room.objects) {
      if (shared->id.value == "chest") {
        LargeObject& chest = shared.edit();
        for (Joint& joint : chest.articulation->joints) {
          joint.value = joint.upper;
        }
        for (const SmallObject& small : chest.small_objects) {
          EXPECT_EQ(findPlacement(home, inMap(chest, small), small.box_model)->parent, small.parent) << small.id.value;
        }
        EXPECT_FALSE(chest.small_objects.empty());
        return;
      }
    }
  }
  FAIL() << "no chest of drawers";
}

TEST(FindPlacement, TheFloorOfARoomOrNowhere) {
  const Home home = papersHouse();
  const Room& bathroom = home.rooms[1];
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : bathroom.outline_map) {
    middle += corner / static_cast<double>(bathroom.outline_map.size());
  }
  const Eigen::Isometry3d T_map_object(Eigen::Translation3d(middle.x(), middle.y(), 0.0));
  const auto found = findPlacement(home, T_map_object, std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->parent, "bathroom");
  EXPECT_EQ(found->relation, Relation::kOn);
  EXPECT_FALSE(findPlacement(home, Eigen::Isometry3d(Eigen::Translation3d(100.0, 0.0, 0.0)), std::nullopt));
}

}  // namespace
}  // namespace oikos::semantic
