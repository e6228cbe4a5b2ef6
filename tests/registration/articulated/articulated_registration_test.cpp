// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/articulated_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "tests/registration/articulated/door_world.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

// Depths are exact, but a pixel in four rows and columns is looked at, and a door's place is taken to be uncertain by 4 mm.
constexpr double kDoorTolerance_rad = 0.5 * kDegree;
constexpr double kDrawerTolerance_m = 0.004;

void expectSame(const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b, double tolerance_m, double tolerance_rad) {
  EXPECT_LT((T_a.translation() - T_b.translation()).norm(), tolerance_m);
  EXPECT_LT(Eigen::AngleAxisd(T_a.linear().transpose() * T_b.linear()).angle(), tolerance_rad);
}

TEST(ArticulatedRegistration, ADoorIsFoundFromAnyStart) {
  DoorWorld world("cabinet", {});
  for (const double true_deg : {0.0, 8.0, 35.0, 80.0, 110.0}) {
    for (const double off_axis_deg : {-40.0, 15.0, 50.0}) {
      world.values = {true_deg * kDegree};
      world.lookFrom(1.7, off_axis_deg);
      for (const double believed_deg : {0.0, 50.0, 110.0}) {
        const ArticulatedResult result = world.registered({believed_deg * kDegree});
        const JointEstimate* door = result.find("door_hinge");
        ASSERT_NE(door, nullptr);
        EXPECT_EQ(door->status, JointStatus::kFound) << true_deg << " from " << off_axis_deg << " believed " << believed_deg;
        EXPECT_NEAR(door->value, world.values[0], kDoorTolerance_rad) << true_deg << " from " << off_axis_deg;
        EXPECT_GT(door->confidence, 0.99);
        EXPECT_GT(door->variance, 0.0);
        EXPECT_EQ(result.status, BaseStatus::kRegistered);
      }
    }
  }
}

TEST(ArticulatedRegistration, DrawersAreFoundFromAnyStart) {
  DoorWorld world("drawer_unit", {});
  for (const std::vector<double>& values : {std::vector<double>{0.0, 0.0, 0.0}, {0.30, 0.0, 0.12}, {0.05, 0.40, 0.2}}) {
    world.values = values;
    world.lookFrom(1.8, -25.0);
    for (const double believed_m : {0.0, 0.4}) {
      const ArticulatedResult result = world.registered({believed_m, believed_m, believed_m});
      ASSERT_EQ(result.joints.size(), 3U);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(result.joints[i].status, JointStatus::kFound) << result.joints[i].name;
        EXPECT_NEAR(result.joints[i].value, values[i], kDrawerTolerance_m) << result.joints[i].name;
      }
    }
  }
}

TEST(ArticulatedRegistration, TwoDoorsAreToldApart) {
  DoorWorld world("cabinet", {{"door_count", "2"}, {"width_m", "0.9"}});
  world.values = {70.0 * kDegree, 15.0 * kDegree};
  const ArticulatedResult result = world.registered({0.0, 100.0 * kDegree});
  EXPECT_NEAR(result.find("left_door_hinge")->value, world.values[0], kDoorTolerance_rad);
  EXPECT_NEAR(result.find("right_door_hinge")->value, world.values[1], kDoorTolerance_rad);
}

/// Both orders come to the truth.
TEST(ArticulatedRegistration, PartAfterPartIsEnoughForExactDepth) {
  DoorWorld world("cabinet", {});
  world.values = {42.0 * kDegree};
  ArticulatedConfig config;
  config.order = SolveOrder::kPartAfterPart;
  const ArticulatedResult result = world.registered({0.0}, config);
  EXPECT_EQ(result.joints[0].status, JointStatus::kFound);
  EXPECT_NEAR(result.joints[0].value, world.values[0], kDoorTolerance_rad);
}

TEST(ArticulatedRegistration, LimitsAreKept) {
  DoorWorld world("cabinet", {{"door_opening_deg", "120"}});
  world.values = {118.0 * kDegree};
  const Scan scan = world.scan();
  const model::ArticulatedModel believed = model::makeShape("cabinet", {{"door_opening_deg", "112"}}, "cabinet");
  ArticulatedRegistration registration(believed, {});
  const ArticulatedResult result = registration.run(scan, world.T_map_camera, world.believed({0.0}));
  EXPECT_LE(result.joints[0].value, 112.0 * kDegree + 1e-12);
  EXPECT_NEAR(result.joints[0].value, 112.0 * kDegree, 3.0 * kDegree);
}

TEST(ArticulatedRegistration, ABelievedValueBeyondTheLimitsIsNoStart) {
  DoorWorld world("cabinet", {});
  world.values = {20.0 * kDegree};
  const ArticulatedResult result = world.registered({-3.0});
  EXPECT_NEAR(result.joints[0].value, world.values[0], kDoorTolerance_rad);
}

TEST(ArticulatedRegistration, TheBaseIsRegisteredAgain) {
  DoorWorld world("cabinet", {});
  world.values = {30.0 * kDegree};
  world.lookFrom(1.8, 40.0);
  Standing believed = world.believed({0.0});
  believed.T_map_model.pretranslate(Eigen::Vector3d(0.03, -0.02, 0.0));
  believed.T_map_model.rotate(Eigen::AngleAxisd(2.0 * kDegree, Eigen::Vector3d::UnitZ()));
  ArticulatedConfig config;
  config.solver.base_sigma_m = 0.05;
  config.solver.base_sigma_deg = 3.0;
  const ArticulatedResult result = ArticulatedRegistration(world.model, config).run(world.scan(), world.T_map_camera, believed);
  EXPECT_EQ(result.status, BaseStatus::kRegistered);
  expectSame(result.T_map_model, world.T_map_model, 0.006, 0.5 * kDegree);
  EXPECT_NEAR(result.joints[0].value, world.values[0], kDoorTolerance_rad);
  EXPECT_GT(result.covariance.ldlt().vectorD().minCoeff(), 0.0);
  EXPECT_LT(result.covariance(0, 0), 0.05 * 0.05);
  EXPECT_LT(result.rms_m, 0.004);
}

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

/// What has no limits is looked for about where it is believed to be.
TEST(ArticulatedRegistration, ASlideWithoutLimitsIsFound) {
  DoorWorld world("drawer_unit", {{"drawer_count", "1"}});
  world.values = {0.25};
  world.model.joints[0].lower = -std::numeric_limits<double>::infinity();
  world.model.joints[0].upper = std::numeric_limits<double>::infinity();
  const ArticulatedResult result = world.registered({0.0});
  EXPECT_EQ(result.joints[0].status, JointStatus::kFound);
  EXPECT_NEAR(result.joints[0].value, 0.25, kDrawerTolerance_m);
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

/// A flap on a door: it hangs on a joint of the door, and a handle is fixed to it.
model::ArticulatedModel cupboardWithFlap() {
  model::ArticulatedModel model = model::makeShape("cabinet", {}, "cabinet");
  const int door = model.joints[0].child;
  model.parts.push_back({"flap", cuboid(Eigen::AlignedBox3d(Eigen::Vector3d(0.0, -0.15, 0.0), Eigen::Vector3d(0.02, 0.15, 0.3)))});
  model.parts.push_back({"grip", cuboid(Eigen::AlignedBox3d(Eigen::Vector3d(0.0, -0.02, -0.02), Eigen::Vector3d(0.03, 0.02, 0.02)))});
  const int flap = static_cast<int>(model.parts.size()) - 2;
  model::ModelJoint slide;
  slide.name = "flap_slide";
  slide.type = model::MotionType::kPrismatic;
  slide.parent = door;
  slide.child = flap;
  slide.T_parent_joint.translation() = Eigen::Vector3d(0.02, 0.3, -0.1);
  slide.axis_joint = Eigen::Vector3d::UnitX();
  slide.upper = 0.2;
  model::ModelJoint fixed;
  fixed.name = "grip_fixed";
  fixed.parent = flap;
  fixed.child = flap + 1;
  fixed.T_parent_joint.translation() = Eigen::Vector3d(0.02, 0.0, 0.25);
  model.joints.push_back(slide);
  model.joints.push_back(fixed);
  return model;
}

TEST(ArticulatedRegistration, ChildrenAreCarriedAlong) {
  DoorWorld world(cupboardWithFlap());
  world.values = {35.0 * kDegree, 0.12, 0.0};
  world.lookFrom(1.7, 25.0);
  const ArticulatedResult result = world.registered({0.0, 0.0, 0.0});
  ASSERT_EQ(result.joints.size(), 2U);
  EXPECT_EQ(result.joints[0].name, "door_hinge");
  EXPECT_EQ(result.joints[1].name, "flap_slide");
  EXPECT_EQ(result.joints[1].status, JointStatus::kFound);
  EXPECT_NEAR(result.joints[0].value, world.values[0], kDoorTolerance_rad);
  EXPECT_NEAR(result.joints[1].value, world.values[1], kDrawerTolerance_m);
  const std::vector<Eigen::Isometry3d> T_model_part = model::Kinematics(world.model).solve(world.values);
  for (std::size_t part = 0; part < T_model_part.size(); ++part) {
    expectSame(result.T_map_part[part], world.T_map_model * T_model_part[part], 0.012, 1.0 * kDegree);
  }
  const auto child = static_cast<std::size_t>(world.model.joints[1].child);
  const auto parent = static_cast<std::size_t>(world.model.joints[1].parent);
  expectSame(result.joints[1].T_map_part, result.T_map_part[child], 1e-12, 1e-6);
  expectSame(result.T_map_part[parent] * result.joints[1].T_parent_part, result.T_map_part[child], 1e-12, 1e-6);
}

TEST(ArticulatedRegistration, KnobsAreNotEstimated) {
  DoorWorld world("oven", {});
  world.values[0] = 50.0 * kDegree;
  const ArticulatedResult result = world.registered(std::vector<double>(world.model.joints.size(), 0.0));
  ASSERT_EQ(result.joints.size(), 1U);
  EXPECT_NEAR(result.joints[0].value, world.values[0], kDoorTolerance_rad);
  EXPECT_EQ(result.joint_values.size(), world.model.joints.size());
}

TEST(ArticulatedRegistration, TheSameImageGivesTheSameNumbersForAnyNumberOfThreads) {
  DoorWorld world("drawer_unit", {});
  world.sensor = camera::DepthSensorKind::kKinect1;
  world.values = {0.1, 0.0, 0.3};
  ArticulatedConfig threads;
  threads.threads = 3;
  const ArticulatedResult one = world.registered({0.0, 0.2, 0.0});
  const ArticulatedResult other = world.registered({0.0, 0.2, 0.0}, threads);
  EXPECT_EQ(one.T_map_model.matrix(), other.T_map_model.matrix());
  EXPECT_EQ(one.covariance, other.covariance);
  EXPECT_EQ(one.joint_values, other.joint_values);
  for (std::size_t i = 0; i < one.joints.size(); ++i) {
    EXPECT_EQ(one.joints[i].variance, other.joints[i].variance);
    EXPECT_EQ(one.joints[i].evidence.log_likelihood, other.joints[i].evidence.log_likelihood);
  }
}

/// One object serves image after image.
TEST(ArticulatedRegistration, NothingIsLeftOverFromTheLastImage) {
  DoorWorld world("cabinet", {});
  world.values = {25.0 * kDegree};
  const ArticulatedResult fresh = world.registered({0.0});
  ArticulatedRegistration registration(world.model, {});
  DoorWorld other = world;
  other.values = {90.0 * kDegree};
  (void)registration.run(other.scan(), other.T_map_camera, other.believed({0.0}));
  const ArticulatedResult again = registration.run(world.scan(), world.T_map_camera, world.believed({0.0}));
  EXPECT_EQ(again.joint_values, fresh.joint_values);
  EXPECT_EQ(again.T_map_model.matrix(), fresh.T_map_model.matrix());
}

/// Depth that is more and more wrong across a door turns it: by as much as is said, if distortion is said to be what it is.
TEST(ArticulatedRegistration, DistortedDepthIsInADoorsVariance) {
  DoorWorld world("cabinet", {});
  world.values = {12.0 * kDegree};
  world.lookFrom(1.7, 0.0);
  world.ramp = 0.02;
  ArticulatedConfig config;
  config.solver.base_sigma_m = 0.001;
  config.solver.base_sigma_deg = 0.05;
  const ArticulatedResult trusting = world.registered({0.0}, config);
  const double off = std::abs(trusting.joints[0].value - world.values[0]);
  EXPECT_GT(off, 3.0 * std::sqrt(trusting.joints[0].variance));

  const double half_width_px = 0.3 / 1.45 * test::kinectCamera().fx;  // of the door, whose front is 1.45 m away
  config.solver.depth_distortion = 2.0 * world.ramp * half_width_px / std::sqrt(3.0) / test::kinectCamera().width;  // root mean square
  const ArticulatedResult told = world.registered({0.0}, config);
  EXPECT_EQ(told.joints[0].value, trusting.joints[0].value);
  const double of_distortion = told.joints[0].variance - trusting.joints[0].variance;
  EXPECT_NEAR(std::sqrt(of_distortion), off, 0.2 * off);
  EXPECT_NEAR(told.joints[0].evidence.shared_variance - trusting.joints[0].evidence.shared_variance, of_distortion, 1e-12);
}

TEST(ArticulatedRegistration, DistortedDepthIsInADrawersVariance) {
  DoorWorld world("drawer_unit", {});
  world.values = {0.2, 0.0, 0.0};
  world.lookFrom(1.7, 0.0);
  ArticulatedConfig config;
  const double trusting = world.registered({0.0, 0.0, 0.0}, config).joints[0].variance;
  config.solver.depth_distortion = 0.01;
  const double told = world.registered({0.0, 0.0, 0.0}, config).joints[0].variance;
  const double height_m = 1.7 - 0.2;  // of the camera before the front: the unit's own depth and the drawer's way come off
  EXPECT_LT(std::sqrt(told - trusting), 0.01 * height_m);
  EXPECT_GT(std::sqrt(told - trusting), 0.5 * 0.01 * (height_m - 0.4));  // outlines tell the rest
}

TEST(ArticulatedRegistration, ConfigurationRules) {
  test::checkConfigRules<ArticulatedConfig>({{"stride_m", "0", "must be > 0"},
                                             {"coarse_thinning", "0", "must be >= 1"},
                                             {"coarse_sigma_m", "0", "must be > 0"},
                                             {"fine_sigma_m", "0", "must be > 0"},
                                             {"profile_tempering", "0", "must be > 0 and <= 1"},
                                             {"most_rivals", "0", "must be >= 1"},
                                             {"rival_share", "2", "must be from 0 to 1"},
                                             {"min_base_pixels", "0", "must be >= 1"},
                                             {"max_unseen_off", "0", "must be > 0"},
                                             {"min_base_share", "2", "must be from 0 to 1"},
                                             {"unlimited_m", "0", "must be > 0"},
                                             {"threads", "0", "must be >= 1"}});
  test::checkConfigRules<JointSolverConfig>({{"base_sigma_m", "0", "must be > 0"},
                                             {"base_sigma_deg", "0", "must be > 0"},
                                             {"upright_sigma_m", "0", "must be > 0"},
                                             {"upright_sigma_deg", "0", "must be > 0"},
                                             {"axis_sigma_m", "0", "must be > 0"},
                                             {"axis_sigma_deg", "-1", "must be >= 0"},
                                             {"surface_sigma_m", "0", "must be > 0"},
                                             {"wide_sigma_m", "0.001", "must be >= 0.005"},
                                             {"depth_distortion", "0.3", "must be from 0 to 0.2"},
                                             {"tempering", "2", "must be > 0 and <= 1"},
                                             {"most_readings", "0", "must be > 0"},
                                             {"rounds", "0", "must be >= 1"}});
  test::checkConfigRules<JointDecisionConfig>({{"window_deg", "0", "must be > 0"},
                                               {"window_m", "0", "must be > 0"},
                                               {"min_confidence", "0.4", "must be from 0.5 to 1"},
                                               {"max_sigma_deg", "0", "must be > 0"},
                                               {"max_sigma_m", "0", "must be > 0"},
                                               {"min_agreeing", "0", "must be >= 1"},
                                               {"min_share", "2", "must be from 0 to 1"},
                                               {"max_hidden", "2", "must be from 0 to 1"},
                                               {"max_spread", "2", "must be from 0 to 1"}});
  ArticulatedConfig broken;
  broken.solver.rounds = 0;
  EXPECT_THROW(ArticulatedRegistration(DoorWorld("cabinet", {}).model, broken), base::ContractViolation);
}

TEST(ArticulatedRegistration, Names) {
  test::checkEnumTable(BaseStatus::kRegistered);
  test::checkEnumTable(SolveOrder::kTogether);
  test::checkEnumTable(JointStatus::kFound);
}

}  // namespace
}  // namespace oikos::registration
