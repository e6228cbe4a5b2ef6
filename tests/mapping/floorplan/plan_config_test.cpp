// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mapping/floorplan/plan_fit.h"
#include "mapping/floorplan/wall_scan.h"
#include "tests/support/config_rules_check.h"

namespace oikos::mapping {
namespace {

TEST(PlanConfig, EachRuleOfTheFit) {
  test::checkConfigRules<PlanFitConfig>({{"min_seen_m", "-1", "must be >= 0"},
                                         {"min_on_plan_share", "1.5", "must be from 0 to 1"},
                                         {"min_supported_share", "-0.5", "must be from 0 to 1"},
                                         {"max_crossed_m", "-1", "must be >= 0"},
                                         {"max_crossed_share", "2", "must be from 0 to 1"},
                                         {"max_missing_m", "-1", "must be >= 0"},
                                         {"max_missing_share", "2", "must be from 0 to 1"},
                                         {"max_floor_outside_m2", "-1", "must be >= 0"},
                                         {"max_beyond_share", "2", "must be from 0 to 1"},
                                         {"max_rms_m", "0", "must be > 0"},
                                         {"max_moved_share", "2", "must be from 0 to 1"},
                                         {"scale_gain", "0", "must be > 0"},
                                         {"on_line_m", "1", "must be from 0.01 to 0.5"},
                                         {"doorway_m", "-1", "must be >= 0"},
                                         {"twin_share", "nan", "must be from 0 to 1"},
                                         {"twin_apart_m", "0", "must be > 0"},
                                         {"twin_apart_deg", "0", "must be > 0"},
                                         {"expected_m", "-1", "must be >= 0"},
                                         {"expected_deg", "-1", "must be >= 0"}});
}

TEST(PlanConfig, EachRuleOfTheSearch) {
  test::checkConfigRules<PlanSearchConfig>({{"cell_m", "1", "must be from 0.02 to 0.5"},
                                            {"blur_m", "2", "must be from 0.02 to 1"},
                                            {"least_turn", "nan", "must be from 0 to 1"},
                                            {"candidates_a_turn", "0", "must be from 1 to 100"},
                                            {"candidates", "0", "must be from 1 to 1000"},
                                            {"apart_m", "0", "must be > 0"}});
}

TEST(PlanConfig, EachRuleOfTheScan) {
  test::checkConfigRules<WallScanConfig>({{"cell_m", "1", "must be from 0.01 to 0.2"},
                                          {"pixel_stride", "0", "must be from 1 to 64"},
                                          {"normal_baseline_m", "2", "must be from 0.01 to 1"},
                                          {"max_range_m", "0", "must be > 0"},
                                          {"min_height_m", "0", "must be from 0.1 to 2"},
                                          {"max_height_m", "9", "must be from 0.2 to 6"},
                                          {"max_height_m", "0.25", "must be > min_height_m"},
                                          {"min_height_bins", "0", "must be from 1 to 30"},
                                          {"floor_band_m", "1", "must be from 0 to 0.2"},
                                          {"max_views", "0", "must be >= 1"}});
}

}  // namespace
}  // namespace oikos::mapping
