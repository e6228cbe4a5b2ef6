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
  ArticulatedConfig broken;
  broken.solver.rounds = 0;
  EXPECT_THROW(ArticulatedRegistration(DoorWorld("cabinet", {}).model, broken), base::ContractViolation);
}

TEST(ArticulatedRegistration, Names) {
  test::checkEnumTable(BaseStatus::kRegistered);
  test::checkEnumTable(SolveOrder::kTogether);
}

}  // namespace
}  // namespace oikos::registration
