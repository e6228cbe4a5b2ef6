// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/registration/articulated/door_world.h"
#include "tests/support/config_rules_check.h"

namespace oikos::registration {
namespace {

/// Depth that is more and more wrong across a door turns it: by as much as is said, if distortion is said to be what it is.
TEST(JointSolver, DistortedDepthIsInADoorsVariance) {
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

TEST(JointSolver, DistortedDepthIsInADrawersVariance) {
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

TEST(JointSolver, ConfigurationRules) {
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
}

}  // namespace
}  // namespace oikos::registration
