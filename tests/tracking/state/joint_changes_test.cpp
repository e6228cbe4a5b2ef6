// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/joint_changes.h"

#include <gtest/gtest.h>

#include <random>

#include "core/base/degrees.h"
#include "tests/support/enum_table_check.h"

namespace oikos::tracking {
namespace {

using registration::JointStatus;
constexpr double kDegree = base::kRadPerDeg;

semantic::Joint hinge(double value_deg) {
  semantic::Joint joint;
  joint.type = semantic::JointType::kRevolute;
  joint.upper = 110.0 * kDegree;
  joint.value = value_deg * kDegree;
  return joint;
}

semantic::Joint slide(double value_m) {
  semantic::Joint joint;
  joint.type = semantic::JointType::kPrismatic;
  joint.upper = 0.4;
  joint.value = value_m;
  return joint;
}

/// A second and a half a stay.
JointStay stay(int number, double value, double sigma, JointStatus status = JointStatus::kFound, int found = 4) {
  JointStay made;
  made.span.status = status;
  made.span.value = value;
  made.span.variance = sigma * sigma;
  made.span.confidence = 0.999;
  made.first_ns = number * 1'500'000'000LL;
  made.first_frame = 45 * number;
  made.best_frame = 45 * number + 3;
  made.images = 5;
  made.found = found;
  return made;
}

JointStay turned(int number, double value_deg, double sigma_deg = 0.7) {
  return stay(number, value_deg * kDegree, sigma_deg * kDegree);
}

TEST(JointChanges, NoiseMakesNone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  int changes = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double believed_deg = 40.0 + noise(random);  // as far off as it may be,
    changes += static_cast<int>(findChanges({turned(0, 40.0 + noise(random), 1.0)}, hinge(believed_deg), {}).size());
    changes += static_cast<int>(findChanges({stay(0, 0.2 + 0.006 * noise(random), 0.006)}, slide(0.2 + 0.006 * noise(random)), {}).size());
  }
  EXPECT_LE(changes, 4);  // of 20,000, at four deviations: 1.3 are to be expected
}

TEST(JointChanges, ADoorThatStandsOpenWasOpened) {
  const auto changes = findChanges({turned(2, 70.0)}, hinge(0.0), {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, JointChangeKind::kOpened);
  EXPECT_EQ(changes[0].before, 0.0);
  EXPECT_NEAR(changes[0].after, 70.0 * kDegree, 1e-12);
  EXPECT_NEAR(changes[0].sigma, 0.7 * kDegree, 1e-12);
  EXPECT_GT(changes[0].confidence, 0.99);
  EXPECT_EQ(changes[0].stay, 0U);
  EXPECT_EQ(changes[0].stay_before, std::nullopt);
}

TEST(JointChanges, ClosedIsClosedToTheLastDegree) {
  const auto changes = findChanges({turned(0, 1.3)}, hinge(35.0), {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, JointChangeKind::kClosed);
  EXPECT_EQ(changes[0].after, 0.0);
  const auto pushed = findChanges({stay(0, 0.006, 0.004)}, slide(0.3), {});
  ASSERT_EQ(pushed.size(), 1U);
  EXPECT_EQ(pushed[0].after, 0.0);
}

TEST(JointChanges, InTheMiddleOfARecordingEachFollowsAStay) {
  const JointStay in_passing = stay(1, 30.0 * kDegree, 0.7 * kDegree, JointStatus::kFound, 1);
  const auto changes = findChanges({turned(0, 0.4), in_passing, turned(1, 60.0), turned(2, 85.0), turned(3, 0.2)}, hinge(0.0), {});
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].kind, JointChangeKind::kOpened);
  EXPECT_EQ(changes[0].stay, 2U);
  EXPECT_EQ(changes[0].stay_before, 0U);
  EXPECT_EQ(changes[1].kind, JointChangeKind::kMoved);
  EXPECT_NEAR(changes[1].before, 60.0 * kDegree, 1e-12);
  EXPECT_EQ(changes[1].stay_before, 2U);
  EXPECT_EQ(changes[2].kind, JointChangeKind::kClosed);
}

TEST(JointChanges, AWideReadingOrANudgeIsNone) {
  EXPECT_TRUE(findChanges({turned(0, 9.0, 3.0)}, hinge(0.0), {}).empty());   // 2.8 deviations
  EXPECT_TRUE(findChanges({turned(0, 3.5, 0.01)}, hinge(0.0), {}).empty());  // less than a change
  EXPECT_TRUE(findChanges({stay(0, 0.014, 0.0)}, slide(0.0), {}).empty());
  EXPECT_EQ(findChanges({turned(0, 9.0, 0.7)}, hinge(0.0), {}).size(), 1U);
}

TEST(JointChanges, WhatWasNotFoundSaysNothing) {
  for (const JointStatus status : {JointStatus::kNotInView, JointStatus::kHidden, JointStatus::kNotObservable, JointStatus::kAmbiguous}) {
    EXPECT_TRUE(findChanges({stay(0, 1.2, 0.01, status)}, hinge(0.0), {}).empty());
  }
  EXPECT_TRUE(findChanges({stay(0, 1.2, 0.01, JointStatus::kFound, 1)}, hinge(0.0), {}).empty());  // one image alone
  ChangeTestConfig lone;
  lone.min_images = 1;
  EXPECT_EQ(findChanges({stay(0, 1.2, 0.01, JointStatus::kFound, 1)}, hinge(0.0), lone).size(), 1U);
  EXPECT_TRUE(findChanges({}, hinge(0.0), {}).empty());
}

TEST(JointChanges, StaysWithinTheLimits) {
  const auto changes = findChanges({turned(0, 111.0)}, hinge(50.0), {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].after, 110.0 * kDegree);
}

TEST(JointChanges, RulesAndNames) {
  EXPECT_TRUE(ChangeTestConfig().validate().empty());
  ChangeTestConfig config;
  config.significance = 0.0;
  config.min_images = 0;
  EXPECT_EQ(config.validate(), (std::vector<std::string>{"significance = 0: must be > 0", "min_images = 0: must be >= 1"}));
  test::checkEnumTable(JointChangeKind::kMoved);
}

}  // namespace
}  // namespace oikos::tracking
