// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/cabinet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "tests/core/model/furniture/furniture_checks.h"

namespace oikos::model {
namespace {

using test::boundsAt;
using test::expectNear;

constexpr double kQuarter_rad = std::numbers::pi / 2.0;

CabinetShape plainCabinet() {
  return {.width_m = 0.5, .depth_m = 0.6, .height_m = 0.9, .handle = HandleStyle::kNone};
}

TEST(Cabinet, ItsBoundsAreItsDimensions) {
  CabinetShape shape = plainCabinet();
  for (shape.door_count = 0; shape.door_count <= 2; ++shape.door_count) {
    const ArticulatedModel model = makeCabinet(shape);
    const Eigen::AlignedBox3d bounds = boundsAt(model, std::vector<double>(model.joints.size(), 0.0));
    expectNear(bounds.min(), {-0.3, -0.25, 0.0}, 1e-7);
    expectNear(bounds.max(), {0.3, 0.25, 0.9}, 1e-7);
    test::expectSound(model);
  }
}

TEST(Cabinet, TheWallCupboardHangsAndTheWorktopStandsOut) {
  CabinetShape shape = plainCabinet();
  shape.bottom_m = 1.4;
  shape.worktop_thickness_m = 0.04;
  shape.worktop_overhang_m = 0.03;
  const Eigen::AlignedBox3d bounds = boundsAt(makeCabinet(shape), {0.0});
  expectNear(bounds.min(), {-0.3, -0.25, 1.4}, 1e-6);
  expectNear(bounds.max(), {0.33, 0.25, 2.3}, 1e-6);
}

TEST(Cabinet, ItsBoardsHaveTheVolumeOfTheirSizes) {
  const CabinetShape shape = {.width_m = 0.5,
                              .depth_m = 0.6,
                              .height_m = 0.9,
                              .board_m = 0.02,
                              .back_m = 0.01,
                              .plinth_height_m = 0.0,
                              .shelf_count = 3,
                              .door_count = 0};
  const double sides = 2.0 * 0.02 * 0.6 * 0.9;
  const double levels = 2.0 * 0.02 * 0.6 * 0.46;
  const double back = 0.01 * 0.46 * 0.86;
  const double shelves = 3.0 * 0.02 * 0.46 * (0.6 - 0.01 - 0.02);
  EXPECT_NEAR(test::volumeM3(*makeCabinet(shape).parts[0].mesh_part), sides + levels + back + shelves, 1e-7);
}

TEST(Cabinet, ADoorOpensToItsHingesSideWithItsHandle) {
  for (const HingeEdge hinge : {HingeEdge::kLeft, HingeEdge::kRight}) {
    CabinetShape shape = plainCabinet();
    shape.handle = HandleStyle::kBarVertical;
    shape.hinge = hinge;
    const ArticulatedModel model = makeCabinet(shape);
    const double side = hinge == HingeEdge::kLeft ? -1.0 : 1.0;  // left of a person who looks along -x is -y
    const double hinge_y = side * (0.25 - 0.0015);
    const double handle_y = -side * (0.25 - 0.0015 - 0.04);
    const double handle_z = model.handles[0].T_part_handle.translation().z() + model.joints[0].T_parent_joint.translation().z();
    const auto handleAt = [&](double value) {
      return (Kinematics(model).solve({value})[1] * model.handles[0].T_part_handle).translation().eval();
    };
    expectNear(handleAt(0.0), {0.3 + 0.03, handle_y, handle_z}, 1e-9);
    // A quarter turn lays the door along +x; the bar then stands out on the hinge's side.
    expectNear(handleAt(kQuarter_rad), {0.3 + std::fabs(handle_y - hinge_y), hinge_y + side * 0.03, handle_z}, 1e-9);
    const Eigen::AlignedBox3d front = boundsAt(model, {kQuarter_rad}, "front");
    expectNear(front.min(), {0.3, std::min(hinge_y, hinge_y - side * 0.018), 0.1015}, 1e-6);
    expectNear(front.max(), {0.3 + 0.497, std::max(hinge_y, hinge_y - side * 0.018), 0.8985}, 1e-6);
    const Eigen::Vector3d out = (Kinematics(model).solve({kQuarter_rad})[1].linear() * model.handles[0].T_part_handle.linear()).col(0);
    expectNear(out, {0.0, side, 0.0}, 1e-9);
  }
}

TEST(Cabinet, FlapsOpenUpwardsAndDownwards) {
  CabinetShape shape = plainCabinet();
  shape.hinge = HingeEdge::kTop;
  expectNear(boundsAt(makeCabinet(shape), {kQuarter_rad}, "front").min(), {0.3, -0.2485, 0.8985 - 0.018}, 1e-6);
  shape.hinge = HingeEdge::kBottom;
  expectNear(boundsAt(makeCabinet(shape), {kQuarter_rad}, "front").max(), {0.3 + 0.797, 0.2485, 0.1015 + 0.018}, 1e-6);
}

TEST(Cabinet, AFlapThatFallsStopsLevel) {
  EXPECT_EQ(makeCabinet({.hinge = HingeEdge::kBottom, .door_opening_rad = 1.9}).joints[0].upper, kQuarter_rad);
  EXPECT_EQ(makeCabinet({.hinge = HingeEdge::kLeft, .door_opening_rad = 1.9}).joints[0].upper, 1.9);
}

TEST(Cabinet, NoDoorRunsIntoTheBodyOrTheOtherDoor) {
  for (const HingeEdge hinge : {HingeEdge::kLeft, HingeEdge::kRight, HingeEdge::kTop, HingeEdge::kBottom}) {
    CabinetShape shape = plainCabinet();
    shape.hinge = hinge;
    shape.handle = HandleStyle::kBarVertical;
    test::expectNoCollision(makeCabinet(shape));
  }
  CabinetShape pair = plainCabinet();
  pair.door_count = 2;
  const ArticulatedModel model = makeCabinet(pair);
  test::expectNoCollision(model);
  for (int step = 1; step <= 18; ++step) {  // the right door, opened alone, passes the closed left one
    const double angle_rad = step * 0.1 * kQuarter_rad;
    EXPECT_FALSE(test::partsCollide(model, {0.0, angle_rad}, 2, 1)) << angle_rad;
  }
}

TEST(Cabinet, SaysWhatIsWrong) {
  const auto expectMessage = [](const CabinetShape& shape, const std::string& message) {
    const auto messages = shape.validate();
    ASSERT_FALSE(messages.empty()) << message;
    EXPECT_EQ(messages.front(), message);
  };
  EXPECT_TRUE(CabinetShape{}.validate().empty());
  expectMessage({.width_m = -1.0}, "furniture.width_m = -1: must be > 0");
  expectMessage({.depth_m = std::nan("")}, "furniture.depth_m = nan: must be > 0");
  expectMessage({.door_count = 3}, "furniture.door_count = 3: must be from 0 to 2");
  expectMessage({.board_m = 0.3}, "furniture.board_m = 0.3: must leave room between the sides: less than width_m / 2");
  expectMessage({.handle_length_m = 1.0}, "furniture.handle_length_m = 1: must fit on the door with handle_offset_m from its edge");
  expectMessage({.shelf_count = 50}, "furniture.shelf_count = 50: must leave room between the shelves");
  expectMessage({.hinge = HingeEdge::kTop, .worktop_thickness_m = 0.03},
                "furniture.worktop_overhang_m = 0.02: must be 0 above a door that is hinged at its top");
  expectMessage({.hinge = HingeEdge::kBottom, .door_gap_m = 0.0, .worktop_thickness_m = 0.03},
                "furniture.door_gap_m = 0: must let the door turn past the worktop: larger, or board_m less");
  EXPECT_THROW(static_cast<void>(makeCabinet({.width_m = -1.0})), base::ContractViolation);
}

TEST(DrawerUnit, DrawersComeOutToTheirLimitAndStayWithinTheirGaps) {
  const DrawerUnitShape shape = {
      .width_m = 0.5, .depth_m = 0.6, .height_m = 0.9, .drawer_count = 4, .extension_ratio = 0.8, .handle = HandleStyle::kBarHorizontal};
  const ArticulatedModel model = makeDrawerUnit(shape);
  test::expectSound(model);
  test::expectNoCollision(model);
  ASSERT_EQ(model.joints.size(), 4U);
  const double box_depth_m = 0.6 - 0.018 - 0.008 - 0.01;
  const auto T_model_part = Kinematics(model).solve({0.0, 0.8 * box_depth_m, 0.0, 0.0});
  EXPECT_NEAR(model.joints[1].upper, 0.8 * box_depth_m, 1e-12);
  expectNear((T_model_part[2] * model.handles[1].T_part_handle).translation(), {0.3 + 0.8 * box_depth_m + 0.03, 0.0, 0.9 - 0.2 * 1.5},
             1e-9);
  expectNear(boundsAt(model, {0.0, 0.0, 0.0, 0.0}).max(), {0.336, 0.25, 0.9}, 1e-6);
}

TEST(DrawerUnit, FrontsShareTheHeightAsTheyWereGiven) {
  DrawerUnitShape shape = {.height_m = 0.9, .drawer_count = 2, .front_heights_m = {0.2, 0.6}, .handle = HandleStyle::kNone};
  const ArticulatedModel model = makeDrawerUnit(shape);
  EXPECT_NEAR(model.joints[0].T_parent_joint.translation().z(), 0.8, 1e-12);
  EXPECT_NEAR(model.joints[1].T_parent_joint.translation().z(), 0.4, 1e-12);
  EXPECT_TRUE(model.handles.empty());
  shape.front_heights_m = {0.2};
  EXPECT_EQ(shape.validate().front(), "furniture.front_heights_m = 1: must be none, or as many as drawer_count");
}

TEST(FurnitureOptions, NamesOfChoicesAreUnique) {
  for (const auto& row : enumTable(HingeEdge{})) {
    EXPECT_EQ(base::findEnum<HingeEdge>(base::toString(row.value)), row.value);
  }
  for (const auto& row : enumTable(HandleStyle{})) {
    EXPECT_EQ(base::findEnum<HandleStyle>(base::toString(row.value)), row.value);
  }
}

}  // namespace
}  // namespace oikos::model
