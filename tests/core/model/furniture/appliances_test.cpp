// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/appliances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/model/furniture/furniture_checks.h"

namespace oikos::model {
namespace {

using test::boundsAt;
using test::expectNear;

constexpr double kQuarter_rad = std::numbers::pi / 2.0;

std::vector<double> closed(const ArticulatedModel& model) {
  return std::vector<double>(model.joints.size(), 0.0);
}

TEST(Fridge, ItsBoundsAreItsDimensionsAndItsDoorsStayClear) {
  for (const FreezerPlace freezer : {FreezerPlace::kNone, FreezerPlace::kBelow, FreezerPlace::kAbove}) {
    FridgeShape shape = {.width_m = 0.55, .depth_m = 0.6, .height_m = 1.7, .freezer = freezer, .handle = HandleStyle::kNone};
    const ArticulatedModel bare = makeFridge(shape);
    expectNear(boundsAt(bare, closed(bare)).min(), {-0.3, -0.275, 0.0}, 1e-7);
    expectNear(boundsAt(bare, closed(bare)).max(), {0.3, 0.275, 1.7}, 1e-7);
    shape.handle = HandleStyle::kBarVertical;
    for (const HingeEdge hinge : {HingeEdge::kLeft, HingeEdge::kRight}) {
      shape.hinge = hinge;
      const ArticulatedModel model = makeFridge(shape);
      test::expectSound(model);
      test::expectNoCollision(model);
      EXPECT_EQ(model.joints.size(), freezer == FreezerPlace::kNone ? 1U : 2U);
      const Eigen::Vector3d handle =
          (Kinematics(model).solve(std::vector<double>(model.joints.size(), kQuarter_rad))[1] * model.handles[0].T_part_handle)
              .translation();
      const double side = hinge == HingeEdge::kLeft ? -1.0 : 1.0;
      expectNear({handle.x(), handle.y(), 0.0}, {0.3 + 0.55 - 0.008 - 0.05, side * (0.275 - 0.004 + 0.03), 0.0}, 1e-9);
    }
  }
}

TEST(Fridge, TheFreezerHasItsHeight) {
  const ArticulatedModel model = makeFridge({.height_m = 1.8, .plinth_height_m = 0.04, .freezer_height_m = 0.6});
  ASSERT_EQ(model.parts[1].name, "freezer_door");
  const Eigen::AlignedBox3f freezer = model.parts[1].mesh_part->bounds();
  const double middle = model.joints[0].T_parent_joint.translation().z();
  EXPECT_NEAR(middle, 0.34, 1e-12);
  EXPECT_NEAR(freezer.sizes().z(), 0.6 - 0.008, 1e-6);
}

TEST(Oven, TheDoorOpensDownwardsWithItsHandleAcross) {
  const OvenShape shape;
  const ArticulatedModel model = makeOven(shape);
  test::expectSound(model);
  test::expectNoCollision(model);
  std::vector<double> values = closed(model);
  const double hinge_z = 0.06 + 0.16 + 0.002;
  const double top_z = 0.85 - 0.012 - 0.11 - 0.002;
  const double length_m = top_z - hinge_z;
  const auto handle = [&] { return Kinematics(model).solve(values)[1] * model.handles[0].T_part_handle; };
  expectNear(handle().translation(), {0.33, 0.0, top_z - 0.045}, 1e-9);
  expectNear(handle().linear().col(2).cwiseAbs(), {0.0, 1.0, 0.0}, 1e-9);
  values[0] = kQuarter_rad;
  expectNear(handle().translation(), {0.3 + length_m - 0.045, 0.0, hinge_z - 0.03}, 1e-9);
  const Eigen::AlignedBox3d front = boundsAt(model, values, "front");
  EXPECT_NEAR(front.max().x(), 0.3 + length_m, 1e-6);
  expectNear(boundsAt(model, values, "glass").center(),
             {0.3 + length_m / 2.0 - 0.3 * 0.2 * length_m, 0.0, boundsAt(model, values, "glass").center().z()}, 1e-6);
}

TEST(Oven, ItsBoundsAreItsDimensions) {
  const OvenShape shape = {.width_m = 0.5, .depth_m = 0.6, .height_m = 0.9, .handle = HandleStyle::kNone, .knob_count = 0};
  const ArticulatedModel model = makeOven(shape);
  expectNear(boundsAt(model, {0.0}).min(), {-0.3, -0.25, 0.0}, 1e-7);
  expectNear(boundsAt(model, {0.0}).max(), {0.3, 0.25, 0.9}, 1e-7);
}

TEST(Oven, EachKnobsMarkPointsWhereItsStateSays) {
  const ArticulatedModel model = makeOven({.knob_count = 3, .knob_state_count = 4, .knob_range_rad = 1.5 * std::numbers::pi});
  ASSERT_EQ(model.knobs.size(), 3U);
  for (std::size_t number = 0; number < model.knobs.size(); ++number) {
    const ModelKnob& knob = model.knobs[number];
    const std::size_t joint = number + 1;
    EXPECT_EQ(model.joints[joint].child, knob.part);
    EXPECT_EQ(model.joints[joint].axis_joint, knob.axis_knob);
    ASSERT_EQ(knob.states.size(), 4U);
    const auto part = static_cast<std::size_t>(knob.part);
    for (int state = 0; state < 4; ++state) {
      const double angle_rad = state * kQuarter_rad;
      EXPECT_EQ(knob.states[static_cast<std::size_t>(state)].name, std::to_string(state));
      EXPECT_NEAR(knob.states[static_cast<std::size_t>(state)].angle_rad, angle_rad, 1e-12);
      std::vector<double> values = closed(model);
      values[joint] = angle_rad;
      const Eigen::Isometry3d T_model_part = Kinematics(model).solve(values)[part];
      const TriangleMesh& mesh = *model.parts[part].mesh_part;
      Eigen::AlignedBox3d mark_part;
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::uint32_t vertex : mesh.triangles[i]) {
          if (mesh.materialOf(i).name == "mark") {
            mark_part.extend(mesh.vertices[vertex].cast<double>());
          }
        }
      }
      // Clockwise for who stands before it: up, to the right (+y), down, to the left.
      Eigen::Vector3d pointing = T_model_part.linear() * mark_part.center();
      pointing.x() = 0.0;
      expectNear(pointing.normalized(), {0.0, std::sin(angle_rad), std::cos(angle_rad)}, 1e-6);
    }
  }
  const double pitch_m = 0.6 / 3.0;
  EXPECT_NEAR(model.joints[2].T_parent_joint.translation().y() - model.joints[1].T_parent_joint.translation().y(), pitch_m, 1e-12);
  EXPECT_LT(model.joints[1].T_parent_joint.translation().y(), 0.0);
}

TEST(Dishwasher, BasketsComeOutOverTheOpenDoor) {
  const ArticulatedModel model = makeDishwasher({.width_m = 0.6, .depth_m = 0.6, .height_m = 0.85});
  test::expectSound(model);
  ASSERT_EQ(model.parts.size(), 4U);
  expectNear(boundsAt(model, closed(model)).min(), {-0.3, -0.3, 0.0}, 1e-7);
  expectNear(boundsAt(model, closed(model)).max(), {0.301, 0.3, 0.85}, 1e-6);
  for (int step = 0; step <= 9; ++step) {
    std::vector<double> values = {step * std::numbers::pi / 18.0, 0.0, 0.0};
    for (std::size_t other : {0, 2, 3}) {
      EXPECT_FALSE(test::partsCollide(model, values, 1, other)) << step << " " << other;
    }
    values = {kQuarter_rad, model.joints[1].upper * step / 9.0, model.joints[2].upper * step / 9.0};
    for (std::size_t basket : {2, 3}) {
      EXPECT_FALSE(test::partsCollide(model, values, basket, 0)) << step;
      EXPECT_FALSE(test::partsCollide(model, values, basket, 1)) << step;
    }
  }
}

TEST(Appliances, SayWhatIsWrong) {
  EXPECT_TRUE(FridgeShape{}.validate().empty());
  EXPECT_TRUE(OvenShape{}.validate().empty());
  EXPECT_TRUE(DishwasherShape{}.validate().empty());
  EXPECT_EQ(FridgeShape{.hinge = HingeEdge::kTop}.validate().front(), "furniture.hinge = top: must be left or right");
  EXPECT_EQ(FridgeShape{.freezer_height_m = 3.0}.validate().front(),
            "furniture.freezer_height_m = 3: must leave room behind each door between the walls");
  EXPECT_EQ(OvenShape{.knob_radius_m = 0.1}.validate().front(), "furniture.knob_radius_m = 0.1: must let all knobs turn on the panel");
  EXPECT_EQ(OvenShape{.door_gap_m = 0.001}.validate().front(),
            "furniture.door_gap_m = 0.001: must let the door turn past the panel: larger, or door_m less");
  EXPECT_EQ(DishwasherShape{.height_m = 0.0}.validate().front(), "furniture.height_m = 0: must be > 0");
  for (const auto& row : enumTable(FreezerPlace{})) {
    EXPECT_EQ(base::findEnum<FreezerPlace>(base::toString(row.value)), row.value);
  }
}

}  // namespace
}  // namespace oikos::model
