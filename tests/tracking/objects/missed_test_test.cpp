// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/missed_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/enum_table_check.h"

namespace oikos::tracking {
namespace {

TimedSight sightOf(int frame, double camera_x_m, SightVerdict verdict) {
  TimedSight timed{frame, frame * 1'000'000'000LL, {camera_x_m, 0.0, 1.0}, {}};
  timed.sight.verdict = verdict;
  timed.sight.against = verdict == SightVerdict::kNotThere ? 1.0 : 0.0;
  timed.sight.through = 100 + frame;
  timed.sight.crop = {frame, frame, frame + 10, frame + 10};
  return timed;
}

ObjectReading tested(const std::vector<TimedSight>& sights) {
  return testMissed(sights, 0.1, {});
}

TEST(MissedTest, TwoImagesFromPlacesApartMissIt) {
  const ObjectReading reading = tested({sightOf(3, 0.0, SightVerdict::kNotThere), sightOf(7, 0.2, SightVerdict::kNotThere)});
  EXPECT_EQ(reading.status, WatchStatus::kMissed);
  EXPECT_EQ(reading.frame, 3);
  EXPECT_EQ(reading.stamp_ns, 3'000'000'000LL);
  EXPECT_EQ(reading.evidence_frame, 7) << "more of it is seen through";
  EXPECT_EQ(reading.crop.left, 7);
  EXPECT_DOUBLE_EQ(reading.confidence, 1.0 - 0.03 * 0.03);
}

/// One in which too few pixels tell to be sure by itself.
TimedSight hintOf(int frame, double camera_x_m, double against) {
  TimedSight timed = sightOf(frame, camera_x_m, SightVerdict::kUnclear);
  timed.sight.against = against;
  return timed;
}

TEST(MissedTest, ASureImageAndHintsFromElsewhereMissIt) {
  const ObjectReading reading = tested({hintOf(3, 0.0, 0.9), sightOf(7, 0.2, SightVerdict::kNotThere)});
  EXPECT_EQ(reading.status, WatchStatus::kMissed);
  EXPECT_EQ(reading.frame, 7) << "the first that is sure";
  EXPECT_EQ(reading.evidence_frame, 7);
  EXPECT_EQ(reading.not_there, 1);
  EXPECT_NEAR(reading.confidence, 1.0 - std::pow(0.03, 1.9), 1e-12);
  EXPECT_EQ(tested({hintOf(1, 0.0, 0.4), sightOf(2, 0.2, SightVerdict::kNotThere), hintOf(3, 0.4, 0.4)}).status, WatchStatus::kMissed);
}

TEST(MissedTest, HintsThatAreWeakFromOnePlaceOrAloneDoNot) {
  const TimedSight sure = sightOf(1, 0.0, SightVerdict::kNotThere);
  EXPECT_EQ(tested({sure, hintOf(2, 0.2, 0.25)}).status, WatchStatus::kUnclear);
  EXPECT_EQ(tested({sure, hintOf(2, 0.05, 0.9)}).status, WatchStatus::kUnclear);
  EXPECT_EQ(tested({hintOf(1, 0.0, 0.9), hintOf(2, 0.2, 0.9), hintOf(3, 0.4, 0.9)}).status, WatchStatus::kUnclear);
  EXPECT_EQ(tested({hintOf(1, 0.0, 0.9), sure, sightOf(2, 0.2, SightVerdict::kThere)}).status, WatchStatus::kThere);
}

TEST(MissedTest, OneImageOrTwoFromOnePlaceDoNot) {
  EXPECT_EQ(tested({}).status, WatchStatus::kUnclear);
  EXPECT_EQ(tested({sightOf(1, 0.0, SightVerdict::kNotThere)}).status, WatchStatus::kUnclear);
  EXPECT_EQ(tested({sightOf(1, 0.0, SightVerdict::kNotThere), sightOf(2, 0.05, SightVerdict::kNotThere)}).status, WatchStatus::kUnclear);
}

TEST(MissedTest, WhatIsSeenAgainIsThereAndWhatGoesLaterIsMissedFromThenOn) {
  const std::vector<TimedSight> again = {sightOf(1, 0.0, SightVerdict::kNotThere), sightOf(2, 0.2, SightVerdict::kNotThere),
                                         sightOf(3, 0.4, SightVerdict::kThere)};
  EXPECT_EQ(tested(again).status, WatchStatus::kThere);
  const std::vector<TimedSight> gone = {sightOf(1, 0.0, SightVerdict::kThere), sightOf(2, 0.2, SightVerdict::kUnclear),
                                        sightOf(3, 0.4, SightVerdict::kNotThere), sightOf(4, 0.6, SightVerdict::kNotThere)};
  EXPECT_EQ(tested(gone).status, WatchStatus::kMissed);
  EXPECT_EQ(tested(gone).frame, 3);
  EXPECT_EQ(tested(gone).there, 1);
}

TEST(MissedTest, HiddenOnlyIfNothingElseTells) {
  EXPECT_EQ(tested({sightOf(1, 0.0, SightVerdict::kHidden), sightOf(2, 0.2, SightVerdict::kUnclear)}).status, WatchStatus::kHidden);
  EXPECT_EQ(tested({sightOf(1, 0.0, SightVerdict::kHidden), sightOf(2, 0.2, SightVerdict::kThere)}).status, WatchStatus::kThere);
  EXPECT_EQ(tested({sightOf(1, 0.0, SightVerdict::kHidden), sightOf(2, 0.2, SightVerdict::kNotThere)}).status, WatchStatus::kUnclear);
}

TEST(MissedTest, NamesComeBack) {
  test::checkEnumTable(SightVerdict::kNotThere);
  test::checkEnumTable(WatchStatus::kMissed);
}

}  // namespace
}  // namespace oikos::tracking
