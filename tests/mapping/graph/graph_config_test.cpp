// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mapping/graph/bundle_adjustment.h"
#include "mapping/graph/covisibility.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/loop_consistency.h"
#include "mapping/graph/pose_graph.h"
#include "tests/support/config_rules_check.h"

namespace oikos::mapping {
namespace {

TEST(GraphConfig, FrontEnd) {
  test::checkConfigRules<FrontEndConfig>({{"pyramid_levels", "0", "must be from 1 to 10"},
                                          {"pyramid_levels", "11", "must be from 1 to 10"},
                                          {"keyframe_overlap", "1.5", "must be from 0 to 1"},
                                          {"keyframe_overlap", "nan", "must be from 0 to 1"},
                                          {"keyframe_rotation_deg", "0", "must be > 0 and <= 180"},
                                          {"keyframe_rotation_deg", "181", "must be > 0 and <= 180"},
                                          {"keyframe_parallax", "0", "must be > 0"},
                                          {"neighbourhood", "-1", "must be >= 0"},
                                          {"borrow_gain", "0", "must be > 0"},
                                          {"frames_a_look", "0", "must be >= 1"},
                                          {"local_keyframes", "0", "must be >= 1"},
                                          {"loop_candidates", "-1", "must be >= 0"},
                                          {"loop_candidates", "0", ""},
                                          {"min_loop_votes", "0", "must be >= 1"},
                                          {"reuse_overlap", "-0.5", "must be from 0 to 1"},
                                          {"settled_views", "0", "must be >= 1"},
                                          {"settled_share", "1.5", "must be from 0 to 1"},
                                          {"kept_sightings", "29", "must be >= 30"},
                                          {"max_lost_frames", "-1", "must be >= 0"},
                                          {"max_lost_frames", "0", ""}});
}

TEST(GraphConfig, NestedRulesCarryTheirTable) {
  FrontEndConfig config;
  config.follower.patch.max_iterations = 0;
  config.motion.min_spread = -1.0;
  EXPECT_EQ(base::validateConfig(config),
            (std::vector<std::string>{"follower.patch.max_iterations = 0: must be >= 1", "motion.min_spread = -1: must be from 0 to 1"}));
}

TEST(GraphConfig, LoopConsistency) {
  test::checkConfigRules<LoopConsistencyConfig>({{"drift_m_per_edge", "0", "must be > 0"},
                                                 {"look_alike_sigmas", "0", "must be > 0"},
                                                 {"drift_rad_per_edge", "0", "must be > 0"},
                                                 {"loop_sigma_m", "-1", "must be > 0"},
                                                 {"loop_sigma_rad", "nan", "must be > 0"},
                                                 {"gate_sigmas", "0", "must be > 0"}});
}

TEST(GraphConfig, PoseGraph) {
  test::checkConfigRules<PoseGraphConfig>({{"max_iterations", "0", "must be >= 1"},
                                           {"information_scale", "0", "must be > 0"},
                                           {"max_information", "-1", "must be > 0"},
                                           {"cauchy_sigmas", "0", "must be > 0"},
                                           {"odometry_sigma_m", "0", "must be > 0"},
                                           {"odometry_sigma_rad", "nan", "must be > 0"},
                                           {"odometry_drift", "-1", "must be >= 0"}});
}

TEST(GraphConfig, Covisibility) {
  test::checkConfigRules<CovisibilityConfig>({{"max_partners", "-1", "must be >= 0"},
                                              {"max_partners", "0", ""},
                                              {"min_expected", "-1", "must be >= 0"},
                                              {"max_sightings", "0", "must be >= 1"},
                                              {"max_view_deg", "0", "must be > 0 and <= 180"},
                                              {"max_view_deg", "200", "must be > 0 and <= 180"},
                                              {"gate_px", "nan", "must be > 0"}});
}

TEST(GraphConfig, BundleAdjustment) {
  test::checkConfigRules<BundleAdjustmentConfig>({{"max_iterations", "0", "must be >= 1"},
                                                  {"pixel_sigma_px", "0", "must be > 0"},
                                                  {"cauchy_sigmas", "0", "must be > 0"},
                                                  {"host_depth_weight", "-1", "must be >= 0"},
                                                  {"host_depth_weight", "0", ""},
                                                  {"sighting_depth_weight", "nan", "must be >= 0"},
                                                  {"readout_sigma_s", "0", "must be > 0"},
                                                  {"settled_sigma_m", "0", "must be > 0"},
                                                  {"settled_sigma_rad", "nan", "must be > 0"},
                                                  {"function_tolerance", "0", "must be > 0"}});
}

}  // namespace
}  // namespace oikos::mapping
