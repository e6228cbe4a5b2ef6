// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_decision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

JointEvidence evidenceOf(const std::vector<double>& log_likelihood, double value_deg) {
  JointEvidence evidence;
  evidence.is_turn = true;
  evidence.log_likelihood = log_likelihood;
  for (std::size_t i = 0; i < log_likelihood.size(); ++i) {
    evidence.values.push_back(5.0 * kDegree * static_cast<double>(i));
  }
  evidence.has_peak = true;
  evidence.value = value_deg * kDegree;
  evidence.peak_log_likelihood = *std::max_element(log_likelihood.begin(), log_likelihood.end()) + 1.0;
  evidence.variance = 1e-4;
  return evidence;
}

constexpr JointSight kGoodSight = {.is_ever_seen = true, .read = 200, .agreeing = 180, .nearer = 15, .behind = 5};

TEST(JointDecision, OnePeakIsFound) {
  std::vector<double> profile(20, 0.0);
  profile[6] = 30.0;
  const JointDecision decision = decide(evidenceOf(profile, 31.0), kGoodSight, {});
  EXPECT_EQ(decision.status, JointStatus::kFound);
  EXPECT_GT(decision.confidence, 0.999);
}

TEST(JointDecision, TwoPeaksAreAmbiguous) {
  std::vector<double> profile(20, 0.0);
  profile[6] = 30.0;
  profile[15] = 29.0;
  EXPECT_EQ(decide(evidenceOf(profile, 30.0), kGoodSight, {}).status, JointStatus::kAmbiguous);
}

TEST(JointDecision, AFlatProfileIsNotObservable) {
  EXPECT_EQ(decide(evidenceOf(std::vector<double>(20, 5.0), 30.0), kGoodSight, {}).status, JointStatus::kNotObservable);
}

TEST(JointDecision, WhatIsSeenThroughOrHiddenIsNotFound) {
  std::vector<double> profile(20, 0.0);
  profile[6] = 30.0;
  const JointEvidence evidence = evidenceOf(profile, 30.0);
  JointSight sight = kGoodSight;
  sight.agreeing = 40;
  sight.behind = 150;
  EXPECT_EQ(decide(evidence, sight, {}).status, JointStatus::kNotObservable);
  sight = kGoodSight;
  sight.agreeing = 10;
  sight.nearer = 150;
  EXPECT_EQ(decide(evidence, sight, {}).status, JointStatus::kHidden);
  sight = kGoodSight;
  sight.agreeing = 3;
  sight.nearer = 0;
  sight.read = 8;
  EXPECT_EQ(decide(evidence, sight, {}).status, JointStatus::kNotObservable);
  sight.is_ever_seen = false;
  EXPECT_EQ(decide(evidence, sight, {}).status, JointStatus::kNotInView);
}

TEST(JointDecision, AWideOrUnexplainedValueIsNotFound) {
  std::vector<double> profile(20, 0.0);
  profile[6] = 30.0;
  JointEvidence evidence = evidenceOf(profile, 30.0);
  evidence.variance = 0.01;
  EXPECT_NE(decide(evidence, kGoodSight, {}).status, JointStatus::kFound);
  evidence = evidenceOf(profile, 30.0);
  evidence.peak_log_likelihood = 2.0;  // solving has led away from the best value
  EXPECT_NE(decide(evidence, kGoodSight, {}).status, JointStatus::kFound);
  for (double& log_likelihood : evidence.log_likelihood) {
    log_likelihood -= 40.0;
  }
  evidence.peak_log_likelihood = -10.0;  // the image is likelier without the part
  EXPECT_NE(decide(evidence, kGoodSight, {}).status, JointStatus::kFound);
}

TEST(JointDecision, MomentsOfAProfile) {
  const JointEvidence evidence = evidenceOf({0.0, 0.0, 0.0}, 0.0);
  const ProfileMoments moments = momentsOf(evidence);
  EXPECT_NEAR(moments.mean, 5.0 * kDegree, 1e-12);
  EXPECT_NEAR(moments.variance, 2.0 / 3.0 * 25.0 * kDegree * kDegree, 1e-12);
}

TEST(JointDecision, ConfigurationRules) {
  test::checkConfigRules<JointDecisionConfig>({{"window_deg", "0", "must be > 0"},
                                               {"window_m", "0", "must be > 0"},
                                               {"min_confidence", "0.4", "must be from 0.5 to 1"},
                                               {"max_sigma_deg", "0", "must be > 0"},
                                               {"max_sigma_m", "0", "must be > 0"},
                                               {"min_agreeing", "0", "must be >= 1"},
                                               {"min_share", "2", "must be from 0 to 1"},
                                               {"max_hidden", "2", "must be from 0 to 1"},
                                               {"max_spread", "2", "must be from 0 to 1"}});
}

TEST(JointDecision, Names) {
  test::checkEnumTable(JointStatus::kFound);
}

}  // namespace
}  // namespace oikos::registration
