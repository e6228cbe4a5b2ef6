// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/room_door.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/model/furniture/furniture_checks.h"

namespace oikos::model {
namespace {

using test::expectNear;

TEST(RoomDoor, ItStandsInItsFrameAndPassesTheJambs) {
  for (const HingeEdge hinge : {HingeEdge::kLeft, HingeEdge::kRight}) {
    const ArticulatedModel model = makeRoomDoor({.width_m = 0.9, .depth_m = 0.16, .height_m = 2.1, .hinge = hinge});
    test::expectSound(model);
    test::expectNoCollision(model);
    expectNear(test::boundsAt(model, {0.0}, "frame").min(), {-0.08, -0.45, 0.0}, 1e-7);
    expectNear(test::boundsAt(model, {0.0}, "frame").max(), {0.08, 0.45, 2.1}, 1e-7);
  }
}

TEST(RoomDoor, BothLeversSwingWithTheLeaf) {
  for (const HingeEdge hinge : {HingeEdge::kLeft, HingeEdge::kRight}) {
    const ArticulatedModel model = makeRoomDoor({.width_m = 0.9, .depth_m = 0.16, .hinge = hinge, .lever_height_m = 1.0});
    const double side = hinge == HingeEdge::kLeft ? -1.0 : 1.0;
    const double leaf_m = 0.9 - 2.0 * 0.044;
    const double reach_m = leaf_m - 0.06 - 0.12 / 2.0;  // from the hinge to the middle of the grip
    ASSERT_EQ(model.handles.size(), 2U);
    const auto leverAt = [&](std::size_t lever, double angle_rad) {
      return Kinematics(model).solve({angle_rad})[1] * model.handles[lever].T_part_handle;
    };
    expectNear(leverAt(0, 0.0).translation(), {0.08 + 0.05, side * (leaf_m / 2.0 - reach_m), 1.0}, 1e-9);
    expectNear(leverAt(1, 0.0).translation(), {0.08 - 0.04 - 0.05, side * (leaf_m / 2.0 - reach_m), 1.0}, 1e-9);
    const double quarter_rad = std::numbers::pi / 2.0;
    expectNear(leverAt(0, quarter_rad).translation(), {0.08 + reach_m, side * (leaf_m / 2.0 + 0.05), 1.0}, 1e-9);
    expectNear(leverAt(1, quarter_rad).translation(), {0.08 + reach_m, side * (leaf_m / 2.0 - 0.04 - 0.05), 1.0}, 1e-9);
    expectNear(leverAt(0, 0.0).linear().col(0), {1.0, 0.0, 0.0}, 1e-9);
    expectNear(leverAt(1, 0.0).linear().col(0), {-1.0, 0.0, 0.0}, 1e-9);
  }
}

TEST(RoomDoor, SaysWhatIsWrong) {
  EXPECT_TRUE(RoomDoorShape{}.validate().empty());
  EXPECT_EQ(RoomDoorShape{.door_gap_m = 0.0}.validate().front(),
            "furniture.door_gap_m = 0: must let the leaf turn past the jamb: larger, or leaf_m less");
  EXPECT_EQ(RoomDoorShape{.depth_m = 0.05}.validate().front(),
            "furniture.leaf_m = 0.04: must leave room for the stop in the frame's depth");
}

}  // namespace
}  // namespace oikos::model
