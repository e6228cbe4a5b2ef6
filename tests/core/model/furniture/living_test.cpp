// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/living.h"

#include <gtest/gtest.h>

#include "tests/core/model/furniture/furniture_checks.h"

namespace oikos::model {
namespace {

using test::expectNear;
using test::volumeM3;

/// Footprint centred, standing on the floor: the bounds are the dimensions.
template <class Shape>
void expectBounds(const ArticulatedModel& model, const Shape& shape) {
  test::expectSound(model);
  const Eigen::AlignedBox3d bounds = test::boundsAt(model, {});
  expectNear(bounds.min(), {-shape.depth_m / 2.0, -shape.width_m / 2.0, 0.0}, 1e-6);
  expectNear(bounds.max(), {shape.depth_m / 2.0, shape.width_m / 2.0, shape.height_m}, 1e-6);
}

TEST(Living, BoundsAreTheDimensions) {
  expectBounds(makeTable({.width_m = 1.7, .depth_m = 0.9, .height_m = 0.75}), TableShape{.width_m = 1.7, .depth_m = 0.9, .height_m = 0.75});
  expectBounds(makeChair({.width_m = 0.4, .depth_m = 0.5, .height_m = 0.9}), ChairShape{.width_m = 0.4, .depth_m = 0.5, .height_m = 0.9});
  expectBounds(makeSofa({.width_m = 1.8, .depth_m = 0.85, .height_m = 0.8}), SofaShape{.width_m = 1.8, .depth_m = 0.85, .height_m = 0.8});
  expectBounds(makeBed({.width_m = 1.4, .depth_m = 2.1, .height_m = 1.0}), BedShape{.width_m = 1.4, .depth_m = 2.1, .height_m = 1.0});
  expectBounds(makeShelf({.width_m = 0.9, .depth_m = 0.35, .height_m = 2.0}), ShelfShape{.width_m = 0.9, .depth_m = 0.35, .height_m = 2.0});
  expectBounds(makeCounter({.width_m = 2.0, .depth_m = 0.65, .height_m = 0.92}),
               CounterShape{.width_m = 2.0, .depth_m = 0.65, .height_m = 0.92});
  expectBounds(makeTv({.width_m = 1.2, .depth_m = 0.25, .height_m = 0.7}), TvShape{.width_m = 1.2, .depth_m = 0.25, .height_m = 0.7});
  expectBounds(makeRug({.width_m = 1.2, .depth_m = 2.0}), RugShape{.width_m = 1.2, .depth_m = 2.0});
}

TEST(Living, ATableHasTheVolumeOfItsBoards) {
  const TableShape shape = {
      .width_m = 1.0, .depth_m = 0.8, .height_m = 0.7, .top_m = 0.03, .leg_m = 0.05, .leg_inset_m = 0.02, .apron_height_m = 0.1};
  const double legs = 4.0 * 0.05 * 0.05 * 0.67;
  const double apron = 2.0 * 0.025 * 0.1 * (1.0 - 0.14 + 0.8 - 0.14);
  EXPECT_NEAR(volumeM3(*makeTable(shape).parts[0].mesh_part), 0.8 * 0.03 + legs + apron, 1e-7);
}

TEST(Living, AShelfHasTheVolumeOfItsBoards) {
  const ShelfShape shape = {.width_m = 0.8, .depth_m = 0.3, .height_m = 2.0, .board_m = 0.02, .back_m = 0.0, .level_count = 4};
  EXPECT_NEAR(volumeM3(*makeShelf(shape).parts[0].mesh_part), 2.0 * 0.02 * 0.3 * 2.0 + 5.0 * 0.02 * 0.3 * 0.76, 1e-7);
}

TEST(Living, SeatsAndMattressesHaveTheirHeights) {
  EXPECT_NEAR(test::boundsAt(makeSofa({.seat_height_m = 0.41}), {}, "cushion").max().z(), 0.41, 1e-6);
  EXPECT_NEAR(test::boundsAt(makeBed({.mattress_top_m = 0.55}), {}, "mattress").max().z(), 0.55, 1e-6);
  const ArticulatedModel chair = makeChair({.seat_height_m = 0.47, .back_board_count = 1});
  EXPECT_EQ(test::boxesOf(*chair.parts[0].mesh_part)[4].max().z(), static_cast<double>(0.47F));
}

TEST(Living, ALampsShadeIsWidestBelow) {
  const ArticulatedModel lamp = makeLamp({.width_m = 0.5, .height_m = 1.5, .shade_height_m = 0.3});
  test::expectSound(lamp);
  const Eigen::AlignedBox3d shade = test::boundsAt(lamp, {}, "shade");
  expectNear(shade.min(), {-0.25, -0.25, 1.2}, 1e-6);
  expectNear(shade.max(), {0.25, 0.25, 1.5}, 1e-6);
}

TEST(Living, SaysWhatIsWrong) {
  EXPECT_EQ(TableShape{.leg_m = 0.5}.validate().front(), "furniture.leg_m = 0.5: must leave room between the legs");
  EXPECT_EQ(ChairShape{.seat_height_m = 1.0}.validate().front(), "furniture.seat_height_m = 1: must be less than height_m");
  EXPECT_EQ(SofaShape{.seat_count = 0}.validate().front(), "furniture.seat_count = 0: must be from 1 to 10");
  EXPECT_EQ(BedShape{.height_m = 0.3}.validate().front(), "furniture.height_m = 0.3: must be at least mattress_top_m");
  EXPECT_EQ(LampShape{.height_m = -2.0}.validate().front(), "furniture.height_m = -2: must be > 0");
  EXPECT_EQ(RugShape{.border_m = 1.0}.validate().front(), "furniture.border_m = 1: must leave room for the middle");
  EXPECT_EQ(TvShape{.body_rgb = 0x1000000}.validate().front(), "furniture.body_rgb = 16777216: must be 0xRRGGBB, at most 16777215");
}

}  // namespace
}  // namespace oikos::model
