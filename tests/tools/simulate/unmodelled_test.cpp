// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/unmodelled.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/model/primitives.h"
#include "semantic/model/outline.h"
#include "tests/tools/simulate/small_home.h"
#include "tools/simulate/world.h"

namespace oikos::simulate {
namespace {

RobotPath alongTheKitchen() {
  FloorPose start;
  start.position_m = {-1.5, -0.5};
  Waypoint end;
  end.position_map = {1.5, -0.5};
  return {start, {end}, {}};
}

Eigen::AlignedBox2d footprintOf(const LooseBox& box) {
  const Eigen::AlignedBox3d bounds_map = box.model.parts.front().mesh_part->bounds().cast<double>().transformed(box.T_map_model);
  return {bounds_map.min().head<2>(), bounds_map.max().head<2>()};
}

TEST(ScatterBoxes, LieOnFreeFloorBesideTheWay) {
  const semantic::Home home = smallHome();
  const Eigen::AlignedBox2d table(Eigen::Vector2d(0.5, -0.4), Eigen::Vector2d(1.5, 0.4));
  int count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<LooseBox> boxes = scatterBoxes(home, alongTheKitchen(), {{table}, 60.0}, 5, seed);
    count += static_cast<int>(boxes.size());
    for (const LooseBox& box : boxes) {
      const Eigen::Vector2d place = box.T_map_model.translation().head<2>();
      EXPECT_EQ(box.T_map_model.translation().z(), 0.0);
      EXPECT_NEAR(box.model.parts.front().mesh_part->bounds().min().z(), 0.0F, 1e-6F);
      EXPECT_TRUE(semantic::isInside(place, home.rooms[0].outline_map) || semantic::isInside(place, home.rooms[1].outline_map));
      const Eigen::Vector2d on_way(std::clamp(place.x(), -1.5, 1.5), -0.5);
      EXPECT_GT(footprintOf(box).exteriorDistance(on_way), 0.2);
      for (const auto& vertex : box.model.parts.front().mesh_part->vertices) {
        const Eigen::Vector2d corner = (box.T_map_model * vertex.cast<double>()).head<2>();
        EXPECT_GT((corner - Eigen::Vector2d(std::clamp(corner.x(), -1.5, 1.5), -0.5)).norm(), 0.39);
        EXPECT_FALSE(table.contains(corner));
      }
    }
  }
  EXPECT_GT(count, 90);  // two rooms of 12 m² have room for five
}

TEST(ScatterBoxes, ComeFromTheirSeedAndAreAsManyAsFindAPlace) {
  const semantic::Home home = smallHome();
  const auto first = scatterBoxes(home, alongTheKitchen(), {}, 3, 1);
  const auto again = scatterBoxes(home, alongTheKitchen(), {}, 3, 1);
  ASSERT_EQ(first.size(), 3U);
  ASSERT_EQ(again.size(), 3U);
  EXPECT_EQ(first[2].T_map_model.matrix(), again[2].T_map_model.matrix());
  EXPECT_NE(first[0].T_map_model.matrix(), scatterBoxes(home, alongTheKitchen(), {}, 3, 2)[0].T_map_model.matrix());
  EXPECT_TRUE(scatterBoxes(home, alongTheKitchen(), {}, 0, 1).empty());
  EXPECT_TRUE(scatterBoxes(semantic::Home(), alongTheKitchen(), {}, 3, 1).empty());
  EXPECT_LT(scatterBoxes(home, alongTheKitchen(), {}, 1000, 1).size(), 400U);
}

TEST(AddUnmodelledPart, TouchesThePieceFromOutside) {
  int has_grown = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    model::ArticulatedModel piece;
    piece.parts.push_back({"body", std::make_shared<const model::TriangleMesh>(model::makeBox({0.5F, 0.6F, 0.9F}))});
    const Eigen::AlignedBox3f before = piece.parts.front().mesh_part->bounds();
    addUnmodelledPart(piece, seed);
    EXPECT_TRUE(validate(*piece.parts.front().mesh_part).empty());
    const Eigen::AlignedBox3f after = piece.parts.front().mesh_part->bounds();
    EXPECT_TRUE(after.contains(before));
    const Eigen::Vector3f grown = after.sizes() - before.sizes();
    has_grown += grown.maxCoeff() > 0.001F ? 1 : 0;
    EXPECT_LT(grown.maxCoeff(), 0.121F) << seed;
  }
  EXPECT_EQ(has_grown, 50);
  model::ArticulatedModel nothing;
  addUnmodelledPart(nothing, 1);
  EXPECT_TRUE(nothing.parts.empty());
}

TEST(World, KnowsWhatTheFurnitureCovers) {
  const World world(smallHome(), {".", 1, 2.5, 0.0});
  Eigen::AlignedBox2d table_and_more;
  for (const Eigen::AlignedBox2d& box : world.footprints()) {
    EXPECT_LT(box.sizes().maxCoeff(), 1.3);  // no room, no wall
    table_and_more.extend(box);
  }
  EXPECT_TRUE(table_and_more.contains(Eigen::Vector2d(1.0, 0.0)));
  EXPECT_TRUE(table_and_more.contains(Eigen::Vector2d(5.6, 0.0)));
}

}  // namespace
}  // namespace oikos::simulate
