// SPDX-License-Identifier: Apache-2.0
// What cannot be seen of a piece, or only in part, and what stands before it and in it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "registration/articulated/articulated_registration.h"
#include "tests/registration/articulated/door_world.h"

namespace oikos::registration {
namespace {

TEST(ArticulatedRegistration, WhatIsOutOfViewIsSaidToBe) {
  DoorWorld world("cabinet", {});
  world.T_map_camera.rotate(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY()));  // looks the other way
  const ArticulatedResult result = world.registered({0.3});
  EXPECT_EQ(result.status, BaseStatus::kNotInView);
  EXPECT_EQ(result.joints[0].status, JointStatus::kNotInView);
  EXPECT_EQ(result.joints[0].value, 0.3);
  EXPECT_GT(result.joints[0].variance, 0.25);  // anywhere in its range
  expectSame(result.T_map_model, world.T_map_model, 1e-12, 1e-9);
  EXPECT_GT(result.covariance(0, 0), 0.0);
}

TEST(ArticulatedRegistration, ADoorSeenFromBehindIsNotFound) {
  DoorWorld world("cabinet", {});
  world.has_wall = false;
  world.lookFrom(2.0, 180.0);
  const ArticulatedResult result = world.registered({0.0});
  EXPECT_NE(result.joints[0].status, JointStatus::kFound);
  EXPECT_NE(result.joints[0].status, JointStatus::kAmbiguous);
}

/// A thin leaf on a block, whose plane goes through the camera: what is left of it are a few pixels (S361).
TEST(ArticulatedRegistration, ALeafSeenEdgeOnIsNotFound) {
  model::ArticulatedModel block;
  block.name = "block";
  block.parts.push_back({"body", cuboid(Eigen::AlignedBox3d(Eigen::Vector3d(-0.3, -0.3, 0.0), Eigen::Vector3d(0.28, 0.3, 0.85)))});
  block.parts.push_back({"leaf", cuboid(Eigen::AlignedBox3d(Eigen::Vector3d(-0.001, 0.0, -0.4), Eigen::Vector3d(0.001, 0.58, 0.4)))});
  model::ModelJoint hinge;
  hinge.name = "hinge";
  hinge.type = model::MotionType::kRevolute;
  hinge.child = 1;
  hinge.T_parent_joint.translation() = Eigen::Vector3d(0.3, -0.29, 0.43);
  hinge.axis_joint = -Eigen::Vector3d::UnitZ();
  hinge.upper = 110.0 * kDegree;
  block.joints.push_back(hinge);
  DoorWorld world(block);
  world.lookFrom(1.8, 0.0);
  const Eigen::Vector3d eye_model = world.T_map_model.inverse() * world.T_map_camera.translation();
  world.values = {std::atan2(eye_model.x() - 0.3, eye_model.y() + 0.29)};
  EXPECT_EQ(world.registered({0.0}).joints[0].status, JointStatus::kNotObservable);
  world.values = {40.0 * kDegree};
  const ArticulatedResult seen = world.registered({0.0});
  EXPECT_EQ(seen.joints[0].status, JointStatus::kFound);
  EXPECT_NEAR(seen.joints[0].value, world.values[0], kDoorTolerance_rad);
}

TEST(ArticulatedRegistration, NoReadingsNoView) {
  const DoorWorld world("cabinet", {});
  Scan scan = world.scan();
  for (ScanPoint& point : scan.points) {
    point = {};
  }
  const ArticulatedResult result = ArticulatedRegistration(world.model, {}).run(scan, world.T_map_camera, world.believed({0.2}));
  EXPECT_EQ(result.joints[0].status, JointStatus::kNotInView);
  EXPECT_EQ(result.status, BaseStatus::kNotInView);
  EXPECT_TRUE(result.T_map_model.matrix().allFinite());
}

/// A sheet that turns about its own middle looks the same after half a turn.
TEST(ArticulatedRegistration, ASheetThatTurnsAboutItsMiddleIsAmbiguous) {
  model::ArticulatedModel sheet;
  sheet.name = "sheet";
  sheet.parts.push_back({"foot", cuboid(Eigen::AlignedBox3d(Eigen::Vector3d(-0.3, -0.3, 0.0), Eigen::Vector3d(0.3, 0.3, 0.1)))});
  sheet.parts.push_back({"leaf", cuboid(Eigen::AlignedBox3d(Eigen::Vector3d(-0.01, -0.3, 0.1), Eigen::Vector3d(0.01, 0.3, 0.9)))});
  model::ModelJoint pivot;
  pivot.name = "pivot";
  pivot.type = model::MotionType::kRevolute;
  pivot.parent = 0;
  pivot.child = 1;
  pivot.upper = 300.0 * kDegree;
  sheet.joints.push_back(pivot);
  DoorWorld world(sheet);
  world.values = {40.0 * kDegree};
  world.lookFrom(1.8, 10.0);
  const ArticulatedResult result = world.registered({0.0});
  EXPECT_EQ(result.joints[0].status, JointStatus::kAmbiguous);
  const double half_turns = result.joints[0].value / std::numbers::pi;
  EXPECT_NEAR(half_turns - std::floor(half_turns), 40.0 / 180.0, 0.01);  // one of the two it is
  EXPECT_GT(std::sqrt(result.joints[0].variance), 30.0 * kDegree);
}

TEST(ArticulatedRegistration, AHandBeforeTheDoorDoesNotPullIt) {
  DoorWorld world("cabinet", {});
  world.values = {0.0};
  world.lookFrom(1.8, 0.0);
  world.obstacles.push_back({Eigen::AlignedBox3d(Eigen::Vector3d(0.32, -0.1, 0.3), Eigen::Vector3d(0.42, 0.25, 0.9))});
  const ArticulatedResult result = world.registered({60.0 * kDegree});
  EXPECT_EQ(result.joints[0].status, JointStatus::kFound);
  EXPECT_NEAR(result.joints[0].value, 0.0, kDoorTolerance_rad);
  EXPECT_GT(result.joints[0].sight.nearer, 50);
}

TEST(ArticulatedRegistration, ADoorBehindAScreenIsHidden) {
  DoorWorld world("cabinet", {});
  world.lookFrom(2.2, 0.0);
  world.obstacles.push_back({Eigen::AlignedBox3d(Eigen::Vector3d(1.2, -1.5, 0.0), Eigen::Vector3d(1.25, 1.5, 1.9))});
  const ArticulatedResult result = world.registered({20.0 * kDegree});
  EXPECT_EQ(result.joints[0].status, JointStatus::kHidden);
  EXPECT_EQ(result.status, BaseStatus::kNotInView);
}

TEST(ArticulatedRegistration, ContentsDoNotPullADoor) {
  DoorWorld world("cabinet", {});
  world.values = {65.0 * kDegree};
  world.lookFrom(1.7, -20.0);
  // Tins just behind the front: a wall of them where the closed door would be, 3 cm farther in.
  world.obstacles.push_back({Eigen::AlignedBox3d(Eigen::Vector3d(0.05, -0.25, 0.13), Eigen::Vector3d(0.24, 0.25, 0.75))});
  const ArticulatedResult result = world.registered({0.0});
  EXPECT_EQ(result.joints[0].status, JointStatus::kFound);
  EXPECT_NEAR(result.joints[0].value, world.values[0], kDoorTolerance_rad);
  expectSame(result.T_map_model, world.T_map_model, 0.006, 0.3 * kDegree);
}

TEST(ArticulatedRegistration, APieceThatIsNotThereHasNoDoors) {
  DoorWorld world("cabinet", {});
  world.values = {20.0 * kDegree};
  Standing believed = world.believed({0.0});
  believed.T_map_model.translate(Eigen::Vector3d(0.0, 1.2, 0.0));
  world.lookFrom(2.2, -25.0);
  const ArticulatedResult result = ArticulatedRegistration(world.model, {}).run(world.scan(), world.T_map_camera, believed);
  EXPECT_NE(result.status, BaseStatus::kRegistered);
  EXPECT_NE(result.joints[0].status, JointStatus::kFound);
}

}  // namespace
}  // namespace oikos::registration
