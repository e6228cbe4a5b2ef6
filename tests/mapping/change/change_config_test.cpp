// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/change_config.h"

#include <gtest/gtest.h>

#include "tests/support/config_rules_check.h"

namespace oikos::mapping {
namespace {

TEST(FreeSpaceConfig, Rules) {
  test::checkConfigRules<FreeSpaceConfig>({
      {"min_views", "0", "must be from 1 to 255"},
      {"min_views", "256", "must be from 1 to 255"},
      {"min_view_angle_rad", "-0.1", "must be from 0 to 1.5"},
      {"max_free_probability", "0.5", "must be > 0 and < 0.5"},
      {"min_occupied_probability", "1", "must be >= 0.5 and < 1"},
      {"min_occupied_probability", "nan", "must be >= 0.5 and < 1"},
  });
}

TEST(ChangeConfig, Rules) {
  test::checkConfigRules<ChangeConfig>({
      {"sigmas", "0.5", "must be from 1 to 10"},
      {"map_sigma_m", "-0.01", "must be >= 0"},
      {"depth_sigma_1m", "-0.01", "must be >= 0"},
      {"max_tolerance_m", "0.01", "must be from 0.05 to 0.5"},
      {"pixel_stride", "0", "must be from 1 to 64"},
      {"min_points", "0", "must be >= 1"},
      {"max_missing_share", "1.5", "must be from 0 to 1"},
      {"min_agreement", "nan", "must be from 0 to 1"},
      {"join_m", "0.6", "must be from 0 to 0.5"},
      {"min_seed_voxels", "0", "must be >= 1"},
      {"min_size_m", "-1", "must be >= 0"},
      {"min_known_share", "2", "must be from 0 to 1"},
      {"max_changed_share", "-0.5", "must be from 0 to 1"},
  });
  ChangeConfig config;
  config.threads = 0;
  EXPECT_EQ(config.validate(), std::vector<std::string>{"threads = 0: must be >= 1"});
}

}  // namespace
}  // namespace oikos::mapping
