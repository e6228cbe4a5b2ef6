// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mapping/odometry/corner_detector.h"
#include "mapping/odometry/features.h"
#include "mapping/odometry/landmark_follower.h"
#include "mapping/odometry/patch_aligner.h"
#include "mapping/odometry/pose_solver.h"
#include "mapping/odometry/relative_motion.h"
#include "tests/support/config_rules_check.h"

namespace oikos::mapping {
namespace {

TEST(OdometryConfig, PatchAligner) {
  test::checkConfigRules<PatchAlignerConfig>({{"max_iterations", "0", "must be >= 1"},
                                              {"max_iterations", "1", ""},
                                              {"converged_px", "0", "must be > 0"},
                                              {"max_step_px", "-1", "must be > 0"},
                                              {"max_step_px", "nan", "must be > 0"},
                                              {"min_correlation", "1.5", "must be from 0 to 1"},
                                              {"min_correlation", "1", ""},
                                              {"coarsest_answer", "-1", "must be from 0 to 10"},
                                              {"coarsest_answer", "11", "must be from 0 to 10"},
                                              {"min_eigenvalue", "-0.5", "must be >= 0"},
                                              {"min_eigenvalue", "0", ""}});
}

TEST(OdometryConfig, PoseSolver) {
  test::checkConfigRules<PoseSolverConfig>({{"max_iterations", "0", "must be >= 1"},
                                            {"huber_sigmas", "0", "must be > 0"},
                                            {"outlier_sigmas", "0", "must be > 0"},
                                            {"outlier_sigmas", "nan", "must be > 0"},
                                            {"depth_weight", "-1", "must be >= 0"},
                                            {"depth_weight", "0", ""},
                                            {"converged", "0", "must be > 0"}});
}

TEST(OdometryConfig, Follower) {
  test::checkConfigRules<FollowerConfig>({{"pixel_sigma_px", "0", "must be > 0"},
                                          {"max_scale", "1", "must be > 1"},
                                          {"border_px", "-1", "must be >= 0"},
                                          {"border_px", "nan", "must be >= 0"},
                                          {"coarsest_level", "-1", "must be from 0 to 10"},
                                          {"coarsest_level", "11", "must be from 0 to 10"},
                                          {"min_inliers", "5", "must be >= 6"},
                                          {"min_inliers", "6", ""},
                                          {"min_inlier_ratio", "1.01", "must be from 0 to 1"}});
}

TEST(OdometryConfig, NestedRulesCarryTheirTable) {
  FollowerConfig config;
  config.patch.max_step_px = 0.0;
  config.pose.depth_weight = -2.0;
  EXPECT_EQ(base::validateConfig(config),
            (std::vector<std::string>{"patch.max_step_px = 0: must be > 0", "pose.depth_weight = -2: must be >= 0"}));
}

TEST(OdometryConfig, CornerDetector) {
  test::checkConfigRules<CornerDetectorConfig>({{"cell_px", "0", "must be from 1 to 1000"},
                                                {"cell_px", "1001", "must be from 1 to 1000"},
                                                {"min_response", "0", "must be > 0"},
                                                {"enough", "-1", "must be >= 0"},
                                                {"min_weak_response", "0", "must be > 0"},
                                                {"max_depth_m", "0", "must be > 0"},
                                                {"max_depth_m", "nan", "must be > 0"},
                                                {"depth_window_px", "0", "must be from 1 to 50"},
                                                {"depth_window_px", "51", "must be from 1 to 50"},
                                                {"max_plane_residual", "0", "must be > 0"}});
}

TEST(OdometryConfig, Features) {
  test::checkConfigRules<FeatureConfig>({{"count", "0", "must be from 1 to 100000"},
                                         {"count", "100001", "must be from 1 to 100000"},
                                         {"image_scale", "0", "must be > 0 and <= 1"},
                                         {"image_scale", "1.5", "must be > 0 and <= 1"},
                                         {"image_scale", "nan", "must be > 0 and <= 1"},
                                         {"image_scale", "1", ""},
                                         {"contrast_threshold", "0", "must be > 0"},
                                         {"fast_threshold", "0", "must be from 1 to 255"},
                                         {"fast_threshold", "256", "must be from 1 to 255"},
                                         {"max_depth_m", "-8", "must be > 0"}});
}

TEST(OdometryConfig, RelativeMotion) {
  test::checkConfigRules<RelativeMotionConfig>({{"max_hypotheses", "0", "must be >= 1"},
                                                {"inlier_px", "0", "must be > 0"},
                                                {"inlier_depth_sigmas", "0", "must be > 0"},
                                                {"min_inliers", "5", "must be >= 6"},
                                                {"min_inlier_ratio", "-0.1", "must be from 0 to 1"},
                                                {"min_spread", "nan", "must be from 0 to 1"},
                                                {"min_spread", "2", "must be from 0 to 1"}});
}

}  // namespace
}  // namespace oikos::mapping
