// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/home_change.h"

#include <gtest/gtest.h>

#include "semantic/model/placement.h"
#include "tests/support/expect_error.h"
#include "tests/tools/simulate/small_home.h"

namespace oikos::simulate {
namespace {

using semantic::kRadPerDeg;

HomeChange changeOf(const std::string& text) {
  const std::optional<HomeChange> change = parseHomeChange(text);
  EXPECT_TRUE(change) << text;
  return change.value_or(HomeChange{});
}

semantic::Home changed(const std::string& text) {
  semantic::Home home = smallHome();
  apply(changeOf(text), home, "scene.toml");
  return home;
}

void expectRefused(const std::string& text, const std::string& message) {
  semantic::Home home = smallHome();
  const semantic::Home before = home;
  test::expectError(base::ErrorCode::kInput, {"scene.toml: changes: " + message}, [&] { apply(changeOf(text), home, "scene.toml"); });
  EXPECT_EQ(home, before) << text;
}

TEST(ParseHomeChange, Joints) {
  const HomeChange turn = changeOf("oven-door-joint 90 deg");
  EXPECT_EQ(turn.id, "oven-door-joint");
  EXPECT_LT(turn.at_s, 0.0);
  EXPECT_DOUBLE_EQ(std::get<JointChange>(turn.what).value, 90.0 * kRadPerDeg);
  EXPECT_EQ(std::get<JointChange>(turn.what).type, semantic::JointType::kRevolute);
  const HomeChange slide = changeOf("@2.5  drawer -0.2 m");
  EXPECT_EQ(slide.at_s, 2.5);
  EXPECT_EQ(std::get<JointChange>(slide.what).value, -0.2);
  EXPECT_EQ(std::get<JointChange>(slide.what).type, semantic::JointType::kPrismatic);
}

TEST(ParseHomeChange, KnobsAndWhatIsGone) {
  EXPECT_EQ(std::get<KnobChange>(changeOf("@0 oven-knob_0 2").what).state, "2");
  EXPECT_EQ(changeOf("@0 oven-knob_0 2").at_s, 0.0);
  EXPECT_TRUE(std::holds_alternative<Gone>(changeOf("cup gone").what));
}

TEST(ParseHomeChange, Moves) {
  const Moved furniture = std::get<Moved>(changeOf("table at 1 2 3 10 20 30").what);
  EXPECT_TRUE(furniture.parent.empty());
  EXPECT_EQ(furniture.pose.position_m, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_LT((furniture.pose.roll_pitch_yaw_rad - kRadPerDeg * Eigen::Vector3d(10.0, 20.0, 30.0)).norm(), 1e-15);
  for (const semantic::Relation relation : {semantic::Relation::kOn, semantic::Relation::kIn, semantic::Relation::kUnder}) {
    const Moved small = std::get<Moved>(changeOf("cup " + std::string(base::toString(relation)) + " drawers at 0 0 0.1 0 0 0").what);
    EXPECT_EQ(small.parent, "drawers");
    EXPECT_EQ(small.relation, relation);
    EXPECT_EQ(small.pose.position_m.z(), 0.1);
  }
}

TEST(ParseHomeChange, EverythingElseIsNone) {
  for (const char* text : {"",
                           "cup",
                           "@1",
                           "@1 cup",
                           "@ cup gone",
                           "@-1 cup gone",
                           "@x cup gone",
                           "@nan cup gone",
                           "door 90 rad",
                           "door x deg",
                           "door inf deg",
                           "door 90 deg now",
                           "table at 1 2 3",
                           "table at 1 2 3 4 5 x",
                           "table at 1 2 3 4 5 6 7",
                           "cup beside table at 0 0 0 0 0 0",
                           "cup on table 0 0 0 0 0 0",
                           "cup on table at 0 0 0 0 0",
                           "cup on table at 0 0 0 0 0 nan",
                           "cup on"}) {
    const std::optional<HomeChange> change = parseHomeChange(text);
    if (std::string(text) == "cup on") {  // a knob's state may have any name
      EXPECT_TRUE(change && std::holds_alternative<KnobChange>(change->what));
    } else {
      EXPECT_FALSE(change) << text;
    }
  }
}

TEST(ApplyHomeChange, Joints) {
  EXPECT_DOUBLE_EQ(jointOf(changed("oven-door-joint 45 deg"), "oven-door-joint").value, 45.0 * kRadPerDeg);
  EXPECT_EQ(jointOf(changed("drawers-drawer_1-joint 0.25 m"), "drawers-drawer_1-joint").value, 0.25);
  EXPECT_EQ(jointOf(changed("drawers-drawer_1-joint 0.25 m"), "drawers-drawer_0-joint").value, 0.0);
}

TEST(ApplyHomeChange, AJointMayTouchItsLimits) {
  const semantic::Joint joint = jointOf(changed("oven-door-joint 90 deg"), "oven-door-joint");
  EXPECT_EQ(joint.value, joint.upper);
  EXPECT_EQ(jointOf(changed("drawers-drawer_1-joint 0 m"), "drawers-drawer_1-joint").value, 0.0);
}

TEST(ApplyHomeChange, AJointStopsAtTheLimitsOfTheTrueHome) {
  semantic::Home home = smallHome();
  apply(changeOf("oven-door-joint 91 deg"), home, "scene.toml", BeyondLimits::kStop);
  EXPECT_EQ(jointOf(home, "oven-door-joint").value, jointOf(home, "oven-door-joint").upper);
  apply(changeOf("drawers-drawer_1-joint -0.1 m"), home, "scene.toml", BeyondLimits::kStop);
  EXPECT_EQ(jointOf(home, "drawers-drawer_1-joint").value, 0.0);
}

TEST(ApplyHomeChange, ACupMovesOnItsTable) {
  const semantic::Home home = changed("cup on table at -0.3 0.1 0.75 0 0 0");
  ASSERT_EQ(pieceOf(home, "table").small_objects.size(), 1U);
  EXPECT_EQ(findSmall(home, "cup")->T_parent_object.position_m.x(), -0.3);
}

TEST(ApplyHomeChange, Knobs) {
  EXPECT_EQ(pieceOf(changed("oven-knob_0 2"), "oven").articulation->knobs.front().current, "2");
}

TEST(ApplyHomeChange, ACupIntoADrawer) {
  const semantic::Home home = changed("cup in drawers-drawer_1 at -0.2 0.05 0.02 0 0 30");
  const semantic::SmallObject* const cup = findSmall(home, "cup");
  ASSERT_NE(cup, nullptr);
  EXPECT_EQ(cup->parent, "drawers-drawer_1");
  EXPECT_EQ(cup->relation, semantic::Relation::kIn);
  EXPECT_TRUE(pieceOf(home, "table").small_objects.empty());
  const semantic::LargeObject& drawers = pieceOf(home, "drawers");
  ASSERT_EQ(drawers.small_objects.size(), 1U);
  const auto T_map_drawer = semantic::findCarrierInMap(drawers, cup->parent);
  ASSERT_TRUE(T_map_drawer);
  // The unit looks along -x of map; the drawer's frame is 0.29 m before its middle and drawn out by 0.1 m.
  const Eigen::Vector3d cup_map = (*T_map_drawer * cup->T_parent_object.toIsometry()).translation();
  EXPECT_LT((cup_map - Eigen::Vector3d(5.6 - 0.29 - 0.1 + 0.2, -0.05, 0.475 + 0.02)).norm(), 1e-9);
}

TEST(ApplyHomeChange, ACupOntoTheFloorOfARoom) {
  const semantic::Home home = changed("cup on study at 4 1 0 0 0 0");
  ASSERT_EQ(home.rooms[1].small_objects.size(), 2U);
  EXPECT_EQ(home.rooms[1].small_objects[1].id.value, "cup");
  EXPECT_EQ(home.rooms[1].small_objects[1].T_parent_object.position_m, Eigen::Vector3d(4.0, 1.0, 0.0));
  EXPECT_EQ(findSmall(home, "cup")->parent, "study");
}

TEST(ApplyHomeChange, FurnitureTakesAlongWhatItCarries) {
  const semantic::Home home = changed("table at 0.5 0.2 0 0 0 90");
  EXPECT_EQ(pieceOf(home, "table").T_map_object.position_m, Eigen::Vector3d(0.5, 0.2, 0.0));
  EXPECT_EQ(pieceOf(home, "table").small_objects.size(), 1U);
}

TEST(ApplyHomeChange, Gone) {
  EXPECT_EQ(findSmall(changed("cup gone"), "cup"), nullptr);
  EXPECT_EQ(findSmall(changed("ball gone"), "ball"), nullptr);
  const semantic::Home home = changed("table gone");
  EXPECT_THROW((void)pieceOf(home, "table"), std::runtime_error);
  EXPECT_EQ(findSmall(home, "cup"), nullptr);
}

TEST(ApplyHomeChange, OtherHomesThatShareThePieceStayAsTheyWere) {
  const semantic::Home before = smallHome();
  semantic::Home after = before;
  apply(changeOf("oven-door-joint 45 deg"), after, "scene.toml");
  EXPECT_EQ(before, smallHome());
}

TEST(ApplyHomeChange, SaysWhatIsWrong) {
  expectRefused("lid 3 deg", "'lid' is no joint of this home");
  expectRefused("cup 3 deg", "'cup' is no joint of this home");
  expectRefused("oven-door-joint 0.1 m", "'oven-door-joint' turns: its value is in deg");
  expectRefused("drawers-drawer_0-joint 3 deg", "'drawers-drawer_0-joint' slides: its value is in m");
  expectRefused("oven-door-joint 91 deg", "'oven-door-joint' = 91: its limits are 0 and 90");
  expectRefused("drawers-drawer_0-joint -0.1 m", "'drawers-drawer_0-joint' = -0.1: its limits are 0 and 0.43");
  expectRefused("dial 3", "'dial' is no knob of this home");
  expectRefused("oven-knob_0 7", "'oven-knob_0' has no state '7'");
  expectRefused("bowl gone", "'bowl' is no object of this home");
  expectRefused("drawers-body gone", "'drawers-body' is no object of this home");
  expectRefused("cup at 0 0 0 0 0 0", "'cup' is no piece of furniture of this home (a small object needs 'on PARENT at …')");
  expectRefused("table on study at 0 0 0 0 0 0", "'table' is no small object of this home");
  expectRefused("cup on shelf at 0 0 0 0 0 0", "'cup' is put onto 'shelf', which is no piece, part or room of this home");
  expectRefused("cup on ball at 0 0 0 0 0 0", "'cup' is put onto 'ball', which is no piece, part or room of this home");
}

}  // namespace
}  // namespace oikos::simulate
