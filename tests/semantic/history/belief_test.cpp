// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/belief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace oikos::semantic {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kHalfLife_s = 10 * kHour_s;

std::int64_t hours(double count) {
  return static_cast<std::int64_t>(count * kHour_s * 1e9);
}

Event event(EventKind kind, double time_h, const std::string& parent, double confidence = 1.0) {
  Event made;
  made.kind = kind;
  made.subject = "cup";
  made.time_ns = hours(time_h);
  made.after = Placement{parent, Relation::kOn, {}};
  made.confidence = confidence;
  return made;
}

const std::vector<Placement> kTableAndShelf{{"table", Relation::kOn, {}}, {"shelf", Relation::kOn, {}}};

double probabilityOf(const Belief& belief, const std::string& parent) {
  for (const PlaceProbability& place : belief.places) {
    if (place.place.parent == parent) {
      return place.probability;
    }
  }
  return 0.0;
}

double sumOf(const Belief& belief) {
  double sum = belief.elsewhere;
  for (const PlaceProbability& place : belief.places) {
    sum += place.probability;
  }
  return sum;
}

TEST(Belief, BeforeAnyEventItIsWhereItIsPutAway) {
  const Belief belief = beliefOf({}, kTableAndShelf, kHalfLife_s, 0);
  EXPECT_NEAR(probabilityOf(belief, "table"), 1.0 / 3, 1e-12);
  EXPECT_NEAR(probabilityOf(belief, "shelf"), 1.0 / 3, 1e-12);
  EXPECT_NEAR(belief.elsewhere, 1.0 / 3, 1e-12);
  EXPECT_FALSE(belief.last_seen);
}

TEST(Belief, WithoutALookItFadesByTheHalfLifeToWhereItIsPutAway) {
  const std::vector<Event> events{event(EventKind::kSighted, 0, "floor")};  // weights: table, shelf, floor, elsewhere 1 each
  for (const double age_h : {0.0, 5.0, 10.0, 20.0, 1000.0}) {
    const double stays = std::exp2(-age_h / 10);
    const Belief belief = beliefOf(events, kTableAndShelf, kHalfLife_s, hours(age_h));
    EXPECT_NEAR(probabilityOf(belief, "floor"), stays + (1 - stays) / 4, 1e-9) << age_h;
    EXPECT_NEAR(probabilityOf(belief, "table"), (1 - stays) / 4, 1e-9) << age_h;
    EXPECT_NEAR(belief.elsewhere, (1 - stays) / 4, 1e-9) << age_h;
    EXPECT_EQ(belief.last_seen->time_ns, 0);
    EXPECT_EQ(belief.expected_at->parent, stays > 1e-9 ? "floor" : "table");
  }
}

TEST(Belief, AMissIsBayesRule) {
  const std::vector<Event> events{event(EventKind::kSighted, 0, "table"), event(EventKind::kMissed, 10, "table", 0.8)};
  const Belief belief = beliefOf(events, kTableAndShelf, kHalfLife_s, hours(10));
  const double table = 0.5 + 0.5 * 0.5;  // weights: table 2, shelf 1, elsewhere 1
  const double shelf = 0.5 * 0.25;
  EXPECT_NEAR(probabilityOf(belief, "table"), table * 0.2 / (1 - table * 0.8), 1e-12);
  EXPECT_NEAR(probabilityOf(belief, "shelf"), shelf / (1 - table * 0.8), 1e-12);
  EXPECT_NEAR(belief.elsewhere, shelf / (1 - table * 0.8), 1e-12);
}

TEST(Belief, ACertainMissSendsItToTheOtherPlaces) {
  for (const double later_h : {0.0, 1.0}) {
    const std::vector<Event> events{event(EventKind::kSighted, 0, "table"), event(EventKind::kMissed, later_h, "table")};
    const Belief belief = beliefOf(events, kTableAndShelf, kHalfLife_s, hours(later_h));
    EXPECT_EQ(probabilityOf(belief, "table"), 0.0);
    EXPECT_NEAR(probabilityOf(belief, "shelf"), 0.5, 1e-12);
    EXPECT_NEAR(belief.elsewhere, 0.5, 1e-12);
    EXPECT_EQ(belief.expected_at->parent, "shelf");
    EXPECT_EQ(belief.last_seen->time_ns, 0);
  }
}

TEST(Belief, AnUnsureSightingLeavesTheRestWhereItWas) {
  const std::vector<Event> events{event(EventKind::kSighted, 0, "table"), event(EventKind::kSighted, 0, "shelf", 0.7)};
  const Belief belief = beliefOf(events, kTableAndShelf, kHalfLife_s, 0);
  EXPECT_NEAR(probabilityOf(belief, "shelf"), 0.7, 1e-12);
  EXPECT_NEAR(probabilityOf(belief, "table"), 0.3, 1e-12);
  EXPECT_EQ(belief.elsewhere, 0.0);
}

TEST(Belief, WhatAPersonSaidIsCertainUntilSomethingNewer) {
  std::vector<Event> events{event(EventKind::kSighted, 0, "table"), event(EventKind::kCorrected, 1, "bath", 0.5)};
  const Belief said = beliefOf(events, kTableAndShelf, kHalfLife_s, hours(500));
  EXPECT_EQ(probabilityOf(said, "bath"), 1.0);
  EXPECT_EQ(said.last_seen->time_ns, 0);
  events.push_back(event(EventKind::kMissed, 11, "shelf"));
  const Belief missed = beliefOf(events, kTableAndShelf, kHalfLife_s, hours(11));
  EXPECT_LT(probabilityOf(missed, "bath"), 0.8);  // half of it has been put away by now
  EXPECT_GT(probabilityOf(missed, "bath"), 0.5);
}

TEST(Belief, WhatTellsOfNoPlaceIsPassedOver) {
  Event knob = event(EventKind::kKnob, 5, "table");
  knob.after = KnobSetting{"on"};
  Event reverted = event(EventKind::kReverted, 5, "shelf");
  const std::vector<Event> plain{event(EventKind::kSighted, 0, "table")};
  const std::vector<Event> more{plain[0], knob, reverted, event(EventKind::kForgotten, 6, "shelf")};
  EXPECT_EQ(probabilityOf(beliefOf(more, kTableAndShelf, kHalfLife_s, hours(9)), "table"),
            probabilityOf(beliefOf(plain, kTableAndShelf, kHalfLife_s, hours(9)), "table"));
}

/// What really happens to an object, and how it is looked for.
struct World {
  double half_life_s = kHalfLife_s;
  std::vector<double> put_away;  ///< probability of each place, the last: elsewhere
};

constexpr int kPlaces = 4;
constexpr double kDetection = 0.85;

std::string placeName(int place) {
  return "p" + std::to_string(place);
}

/// A shared draw from the filter's own prior over habits: Dirichlet with all weights 1.
std::vector<double> randomHabits(std::mt19937& random) {
  std::exponential_distribution<double> weight(1.0);
  std::vector<double> habits(kPlaces + 1);
  double sum = 0.0;
  for (double& habit : habits) {
    sum += habit = weight(random);
  }
  for (double& habit : habits) {
    habit /= sum;
  }
  return habits;
}

struct Prediction {
  double probability = 0.0;
  double last_seen_there = 0.0;  ///< 1: yes
  double base_rate = 0.0;
  bool is_there = false;
};

/// One object, its history, and the question whether it is at one place picked at random.
Prediction simulate(std::mt19937& random, const World& world) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::discrete_distribution<int> put_away(world.put_away.begin(), world.put_away.end());
  std::vector<Placement> defaults;
  for (int p = 0; p < kPlaces; ++p) {
    defaults.push_back({placeName(p), Relation::kOn, {}});
  }
  int truth = put_away(random);
  double now_h = 0.0;
  std::string last_seen;
  std::vector<Event> events;
  const int looks = 3 + static_cast<int>(random() % 20);
  std::exponential_distribution<double> pause_h(1.0 / 3.0);
  for (int look = 0; look <= looks; ++look) {
    const double step_h = pause_h(random);
    now_h += step_h;
    if (uniform(random) > std::exp2(-step_h * kHour_s / world.half_life_s)) {
      truth = put_away(random);
    }
    if (look == looks) {
      break;
    }
    const int place = static_cast<int>(random() % kPlaces);
    const bool seen = truth == place && uniform(random) < kDetection;
    events.push_back(event(seen ? EventKind::kSighted : EventKind::kMissed, now_h, placeName(place), seen ? 1.0 : kDetection));
    last_seen = seen ? placeName(place) : last_seen;
  }
  const int asked = static_cast<int>(random() % kPlaces);
  const Belief belief = beliefOf(events, defaults, kHalfLife_s, hours(now_h));
  EXPECT_NEAR(sumOf(belief), 1.0, 1e-9);
  return {probabilityOf(belief, placeName(asked)), last_seen == placeName(asked) ? 1.0 : 0.0, 1.0 / (kPlaces + 1), truth == asked};
}

struct Scores {
  double filter = 0.0;
  double last_seen = 0.0;
  double base_rate = 0.0;
};

Scores brierScores(const std::vector<Prediction>& predictions) {
  Scores scores;
  for (const Prediction& p : predictions) {
    const double truth = p.is_there ? 1.0 : 0.0;
    scores.filter += std::pow(p.probability - truth, 2) / static_cast<double>(predictions.size());
    scores.last_seen += std::pow(p.last_seen_there - truth, 2) / static_cast<double>(predictions.size());
    scores.base_rate += std::pow(p.base_rate - truth, 2) / static_cast<double>(predictions.size());
  }
  return scores;
}

struct Bin {
  int count = 0;
  double predicted = 0.0;
  double there = 0.0;
  double variance = 0.0;  ///< of `there`, if the predictions are right
};

std::array<Bin, 10> reliabilityTable(const std::vector<Prediction>& predictions) {
  std::array<Bin, 10> table;
  for (const Prediction& p : predictions) {
    Bin& bin = table[std::min<std::size_t>(static_cast<std::size_t>(p.probability * 10), 9)];
    ++bin.count;
    bin.predicted += p.probability;
    bin.there += p.is_there ? 1.0 : 0.0;
    bin.variance += p.probability * (1 - p.probability);
  }
  return table;
}

std::vector<Prediction> simulateMany(double half_life_s, unsigned seed) {
  constexpr int kObjects = 6000;
  std::mt19937 random(seed);
  std::vector<Prediction> predictions;
  for (int i = 0; i < kObjects; ++i) {
    predictions.push_back(simulate(random, {half_life_s, randomHabits(random)}));
  }
  return predictions;
}

void recordTable(const std::array<Bin, 10>& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Bin& bin = table[i];
    testing::Test::RecordProperty("bin" + std::to_string(i), std::to_string(bin.predicted / bin.count) + " predicted, " +
                                                                 std::to_string(bin.there / bin.count) +
                                                                 " found, n = " + std::to_string(bin.count));
  }
}

TEST(BeliefCalibration, ProbabilitiesAreWhatHappens) {
  const std::vector<Prediction> predictions = simulateMany(kHalfLife_s, 1);
  const Scores brier = brierScores(predictions);
  EXPECT_LT(brier.filter, 0.75 * brier.base_rate);
  EXPECT_LT(brier.filter, 0.75 * brier.last_seen);
  const std::array<Bin, 10> table = reliabilityTable(predictions);
  recordTable(table);
  for (const Bin& bin : table) {
    ASSERT_GT(bin.count, 50);
    EXPECT_NEAR(bin.there, bin.predicted, 3 * std::sqrt(bin.variance)) << bin.predicted / bin.count << " predicted, n = " << bin.count;
  }
}

TEST(BeliefCalibration, AHalfLifeThatIsWrongByAFactorOfTwoStillHelps) {
  constexpr double kSurvivalOff = 0.25;  // the greatest difference of 2^-x and 2^-2x
  for (const double factor : {0.5, 2.0}) {
    const std::vector<Prediction> predictions = simulateMany(factor * kHalfLife_s, 2);
    const Scores brier = brierScores(predictions);
    EXPECT_LT(brier.filter, brier.base_rate) << factor;
    EXPECT_LT(brier.filter, brier.last_seen) << factor;
    for (const Bin& bin : reliabilityTable(predictions)) {
      EXPECT_NEAR(bin.there / bin.count, bin.predicted / bin.count, kSurvivalOff) << factor;
    }
  }
}

}  // namespace
}  // namespace oikos::semantic
