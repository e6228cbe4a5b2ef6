// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/knob_stays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/config.h"
#include "tests/support/config_rules_check.h"
#include "tracking/state/knob_events.h"

namespace oikos::tracking {
namespace {

using recognition::KnobStatus;
constexpr std::size_t kStates = 5;

/// A picture a tenth of a second after the one before it that gives `probability` to a state, and the rest to the others alike.
KnobSighting picture(int frame, std::size_t state, double probability, KnobStatus status = KnobStatus::kRead) {
  KnobSighting sighting{frame, frame * 100'000'000LL, {}};
  sighting.reading.status = status;
  sighting.reading.diameter_px = 30.0 + frame;
  sighting.reading.centre_px = {100.0, 50.0};
  if (status == KnobStatus::kRead || status == KnobStatus::kCannotTell) {
    sighting.reading.state = state;
    sighting.reading.probability = probability;
    sighting.reading.state_probabilities.assign(kStates, (1.0 - probability) / (kStates - 1));
    sighting.reading.state_probabilities[state] = probability;
  }
  return sighting;
}

std::vector<KnobSighting> pictures(const std::vector<std::size_t>& states, double probability = 0.98) {
  std::vector<KnobSighting> sightings;
  for (const std::size_t state : states) {
    sightings.push_back(picture(static_cast<int>(sightings.size()), state, probability));
  }
  return sightings;
}

TEST(KnobStays, OneSettingIsOneStay) {
  const std::vector<KnobStay> stays = fuseSightings(pictures({3, 3, 3, 3}), kStates, {});
  ASSERT_EQ(stays.size(), 1U);
  EXPECT_EQ(stays[0].state, 3U);
  EXPECT_EQ(stays[0].images, 4);
  EXPECT_EQ(stays[0].found, 4);
  EXPECT_EQ(stays[0].first_frame, 0);
  EXPECT_EQ(stays[0].last_frame, 3);
  EXPECT_EQ(stays[0].best_frame, 3);  // the largest
  EXPECT_EQ(stays[0].crop.left, 50);  // 1.5 diameters beside the middle
  EXPECT_EQ(stays[0].crop.top, 0);    // within the picture
  EXPECT_EQ(stays[0].crop.right, 150);
  // Of five states: the likelihood ratio of two states is 0.98 / 0.005 a picture; the first counts in full, the others half.
  const double ratio = std::pow(0.98 / 0.005, 1.0 + 3 * 0.5);
  EXPECT_NEAR(stays[0].probability, ratio / (ratio + 4.0), 1e-9);
}

TEST(KnobStays, ATurnIsFoundAtItsPicture) {
  const std::vector<KnobStay> stays = fuseSightings(pictures({0, 0, 0, 4, 4}), kStates, {});
  ASSERT_EQ(stays.size(), 2U);
  EXPECT_EQ(stays[0].state, 0U);
  EXPECT_EQ(stays[0].last_frame, 2);
  EXPECT_EQ(stays[1].state, 4U);
  EXPECT_EQ(stays[1].first_frame, 3);
  EXPECT_EQ(stays[1].first_ns, 300'000'000);
}

TEST(KnobStays, OnePictureThatIsWrongTurnsNothing) {
  const std::vector<KnobStay> stays = fuseSightings(pictures({2, 2, 1, 2, 2}, 0.999), kStates, {});
  ASSERT_EQ(stays.size(), 1U);
  EXPECT_EQ(stays[0].state, 2U);
  EXPECT_EQ(stays[0].images, 5);
  EXPECT_EQ(stays[0].found, 4);
}

TEST(KnobStays, PicturesThatCannotTellAddUpButReadNothing) {
  std::vector<KnobSighting> sightings;
  for (int i = 0; i < 8; ++i) {
    sightings.push_back(picture(i, 2, 0.7, KnobStatus::kCannotTell));
  }
  const std::vector<KnobStay> stays = fuseSightings(sightings, kStates, {});
  ASSERT_EQ(stays.size(), 1U);
  EXPECT_EQ(stays[0].state, 2U);
  EXPECT_EQ(stays[0].found, 0);
  EXPECT_GT(stays[0].probability, 0.99);
  EXPECT_FALSE(stays[0].isTold({}));
}

TEST(KnobStays, WhatIsBetweenTheStatesSaysNothing) {
  KnobSighting between = picture(0, 1, 0.0, KnobStatus::kCannotTell);
  between.reading.state_probabilities.assign(kStates, 0.0);
  const std::vector<KnobStay> stays = fuseSightings({between}, kStates, {});
  ASSERT_EQ(stays.size(), 1U);
  EXPECT_NEAR(stays[0].probability, 1.0 / kStates, 1e-12);
}

TEST(KnobStays, NothingSeenIsNoStay) {
  EXPECT_TRUE(fuseSightings({}, kStates, {}).empty());
  EXPECT_TRUE(fuseSightings({picture(0, 0, 0.0, KnobStatus::kNotFound), picture(1, 0, 0.0, KnobStatus::kNotInView)}, kStates, {}).empty());
}

TrackedKnob knobOf(const std::vector<KnobSighting>& sightings) {
  return {{"oven"}, {"oven-knob"}, {"off", "1", "2", "3", "4"}, fuseSightings(sightings, kStates, {}), 0, {}};
}

TEST(KnobTurns, AreTestedAgainstWhatIsKnown) {
  EXPECT_TRUE(findTurns(knobOf(pictures({0, 0, 0})), "off", {}).empty());
  const std::vector<KnobTurn> turns = findTurns(knobOf(pictures({2, 2, 2, 0, 0})), "off", {});
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(turns[0].before, "off");
  EXPECT_EQ(turns[0].after, "2");
  EXPECT_EQ(turns[0].stay.first_frame, 0);
  EXPECT_EQ(turns[1].before, "2");
  EXPECT_EQ(turns[1].after, "off");
  EXPECT_EQ(turns[1].stay.first_frame, 3);
}

TEST(KnobTurns, OnePictureIsNone) {
  EXPECT_TRUE(findTurns(knobOf(pictures({2})), "off", {}).empty());
  EXPECT_EQ(findTurns(knobOf(pictures({2})), "off", {.min_images = 1}).size(), 1U);
}

TEST(KnobTrackConfig, RefusesWhatMakesNoSense) {
  test::checkConfigRules<KnobTestConfig>({{"error_share", "0", "must be from 1e-09 to 0.5"},
                                          {"tempering", "1.5", "must be from 0.01 to 1"},
                                          {"turning_share", "0.9", "must be from 1e-09 to 0.5"},
                                          {"min_probability", "nan", "must be from 0 to 1"},
                                          {"min_images", "0", "must be >= 1"}});
  test::checkConfigRules<KnobTrackConfig>(
      {{"hidden_m", "0", "must be > 0"}, {"enough_px", "-1", "must be > 0"}, {"most_frames", "0", "must be >= 1"}});
}

}  // namespace
}  // namespace oikos::tracking
