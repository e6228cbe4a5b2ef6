// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_moment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/degrees.h"
#include "core/base/error.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = base::kRadPerDeg;
constexpr JointStep kOpened{0.0, 60.0 * kDegree};

/// An image of a door whose profile is `log_likelihood(deg)`, which it has not found.
template <class LogLikelihood>
JointSighting unsure(const LogLikelihood& log_likelihood) {
  JointSighting sighting;
  sighting.status = JointStatus::kNotObservable;
  sighting.evidence.is_turn = true;
  for (int i = 0; i <= 36; ++i) {
    sighting.evidence.values.push_back(2.5 * kDegree * i);
    sighting.evidence.log_likelihood.push_back(log_likelihood(2.5 * i));
  }
  return sighting;
}

JointSighting found(double value_deg) {
  JointSighting sighting = unsure([&](double deg) { return 30.0 - std::min(30.0, 0.1 * (deg - value_deg) * (deg - value_deg)); });
  sighting.status = JointStatus::kFound;
  sighting.confidence = 0.999;
  sighting.evidence.has_peak = true;
  sighting.evidence.value = value_deg * kDegree;
  sighting.evidence.variance = 0.25 * kDegree * kDegree;
  return sighting;
}

JointSighting silent() {
  return unsure([](double) { return 0.0; });
}

JointSighting notInView() {
  JointSighting sighting = silent();
  sighting.status = JointStatus::kNotInView;
  sighting.evidence.log_likelihood.clear();
  return sighting;
}

/// It is not shut; how far it is open cannot be told.
JointSighting notShut() {
  return unsure([](double deg) { return deg < 10.0 ? -15.0 : 0.0; });
}

TEST(JointMoment, BetweenTwoImages) {
  const auto moment = findMoment({found(0.3), found(0.0), found(60.5), found(59.8)}, kOpened, {});
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->first_after, 2U);
  EXPECT_EQ(moment->last_before, 1U);
}

TEST(JointMoment, ImagesThatCannotTellLeaveItOpen) {
  const auto moment = findMoment({found(0.0), silent(), notInView(), silent(), found(60.0)}, kOpened, {});
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->first_after, 4U);
  EXPECT_EQ(moment->last_before, 0U);
}

TEST(JointMoment, WhatHasNotFoundItMayRefuteTheOldValue) {
  const auto moment = findMoment({found(0.0), silent(), notShut(), silent(), found(60.0)}, kOpened, {});
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->first_after, 2U);
  EXPECT_EQ(moment->last_before, 0U);
}

/// A door takes a second or two: it has left its place when it is on its way.
TEST(JointMoment, OnItsWayItHasLeft) {
  const auto moment = findMoment({found(0.0), found(0.1), found(14.0), found(28.0), found(45.0), found(60.0), found(60.0)}, kOpened, {});
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->first_after, 2U);
  EXPECT_EQ(moment->last_before, 1U);
}

TEST(JointMoment, AMisreadingIsOutvoted) {
  const auto early = findMoment({found(0.0), found(60.0), found(0.0), found(0.0), found(60.0), found(60.0)}, kOpened, {});
  ASSERT_TRUE(early);
  EXPECT_EQ(early->first_after, 4U);
  EXPECT_EQ(early->last_before, 3U);
  const auto late = findMoment({found(0.0), found(0.0), found(60.0), found(60.0), found(0.0), found(60.0)}, kOpened, {});
  ASSERT_TRUE(late);
  EXPECT_EQ(late->first_after, 2U);
}

TEST(JointMoment, BeforeTheFirstImageOrNever) {
  const auto moment = findMoment({silent(), found(60.0), found(60.0)}, kOpened, {});
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->first_after, 1U);
  EXPECT_EQ(moment->last_before, std::nullopt);
  EXPECT_FALSE(findMoment({}, kOpened, {}));
  EXPECT_FALSE(findMoment({found(0.0), silent(), found(0.0)}, kOpened, {}));
  EXPECT_FALSE(findMoment({found(0.0), found(60.0), found(0.0), found(0.0)}, kOpened, {}));  // it never was
}

/// By less than the window within which values are the same.
TEST(JointMoment, ASmallStep) {
  const auto moment = findMoment({found(0.0), found(0.4), found(4.6), found(5.1)}, {0.0, 5.0 * kDegree}, {});
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->first_after, 2U);
  EXPECT_EQ(moment->last_before, 1U);
}

TEST(JointMoment, OddsByImage) {
  const std::vector<double> odds = stepOdds({found(0.0), silent(), notInView(), notShut(), found(60.0)}, kOpened, {});
  ASSERT_EQ(odds.size(), 5U);
  EXPECT_LT(odds[0], -3.0);
  EXPECT_EQ(odds[1], 0.0);
  EXPECT_EQ(odds[2], 0.0);
  EXPECT_GT(odds[3], 1.0);
  EXPECT_GT(odds[4], 3.0);
  EXPECT_THROW((void)stepOdds({found(0.0)}, {0.5, 0.5}, {}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::registration
