// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/start_search.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/config_rules_check.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(StartSearch, APriorIsWideByItsPlaceOrItsHeading) {
  CameraPrior prior;
  prior.sigma_m = 0.05;
  prior.sigma_rad = 3.0 * kDegree;
  EXPECT_FALSE(isWide(prior, {}));
  prior.sigma_m = 0.1;
  EXPECT_TRUE(isWide(prior, {}));
  prior.sigma_m = 0.05;
  prior.sigma_rad = 6.0 * kDegree;
  EXPECT_TRUE(isWide(prior, {}));
}

TEST(StartSearch, ANarrowPriorHasNoOtherStarts) {
  CameraPrior prior;
  prior.sigma_m = 0.02;  // as after a map
  prior.sigma_rad = 1.0 * kDegree;
  EXPECT_FALSE(hasOtherStarts(prior, {}));
  prior.sigma_rad = 3.0 * kDegree;
  EXPECT_TRUE(hasOtherStarts(prior, {}));
  prior.sigma_m = 0.05;
  prior.sigma_rad = 1.0 * kDegree;
  EXPECT_TRUE(hasOtherStarts(prior, {}));
}

TEST(StartSearch, WhatIsSeenThroughWeighsMoreThanWhatIsSeen) {
  const CameraPrior prior;
  const StartSearchConfig config;
  const double plain = explains({1000, 500, 0, 0}, prior.T_map_camera, prior, config);
  EXPECT_DOUBLE_EQ(plain, 0.5);
  EXPECT_DOUBLE_EQ(explains({1000, 500, 100, 0}, prior.T_map_camera, prior, config), 0.5 - 0.1 * config.through_cost);
  EXPECT_DOUBLE_EQ(explains({1000, 500, 0, 100}, prior.T_map_camera, prior, config), 0.5 - 0.1 * config.before_cost);
  EXPECT_LT(explains({1000, 700, 100, 0}, prior.T_map_camera, prior, config), plain);
  EXPECT_DOUBLE_EQ(explains({}, prior.T_map_camera, prior, config), 0.0);
}

TEST(StartSearch, FartherFromThePriorIsWorse) {
  CameraPrior prior;
  prior.sigma_m = 0.1;
  const StartSearchConfig config;
  const Eigen::Isometry3d T_map_aside(Eigen::Translation3d(0.2, 0.0, 0.0));
  EXPECT_NEAR(explains({1000, 500, 0, 0}, T_map_aside, prior, config), 0.5 - 4.0 * config.prior_share, 1e-12);
}

TEST(StartSearchConfig, Rules) {
  test::checkConfigRules<StartSearchConfig>({{"wide_m", "-1", "must be >= 0"},
                                             {"wide_deg", "-1", "must be >= 0"},
                                             {"reach", "0", "must be > 0"},
                                             {"turn_reach", "0", "must be > 0"},
                                             {"thinning", "0", "must be >= 1"},
                                             {"iterations", "0", "must be >= 1"},
                                             {"best", "0", "must be >= 1"},
                                             {"through_cost", "-1", "must be >= 0"},
                                             {"before_cost", "-1", "must be >= 0"},
                                             {"prior_share", "-1", "must be >= 0"}});
}

}  // namespace
}  // namespace oikos::registration
