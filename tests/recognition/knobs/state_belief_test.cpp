// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/state_belief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace oikos::recognition {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Templates of which those near an angle fit best (the template's number times 5 degrees).
std::vector<double> bestAt(double angle_deg, double depth = 0.8) {
  std::vector<double> unexplained;
  for (int i = 0; i < 72; ++i) {
    const double off = std::remainder(5.0 * i - angle_deg, 360.0) / 12.0;
    unexplained.push_back(1.0 - depth * std::exp(-0.5 * off * off));
  }
  return unexplained;
}

std::vector<model::ModelKnobState> nine() {
  std::vector<model::ModelKnobState> states;
  for (int i = 0; i < 9; ++i) {
    states.push_back({std::to_string(i), 40.0 * i * kDegree});
  }
  return states;
}

TEST(StateBelief, TheAngleLiesBetweenTemplates) {
  for (const double angle_deg : {0.0, 2.5, 101.3, 358.0}) {
    const AngleBelief belief = believeAngle(bestAt(angle_deg), {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 60.0});
    EXPECT_NEAR(std::remainder(belief.angle_rad / kDegree - angle_deg, 360.0), 0.0, 0.6) << angle_deg;
    EXPECT_NEAR(std::accumulate(belief.density.begin(), belief.density.end(), 0.0), 1.0, 1e-9);
    EXPECT_LT(belief.sigma_rad, 5.0 * kDegree);
  }
}

TEST(StateBelief, ZeroAndDirectionAreThoseOfTheRule) {
  const AngleBelief belief = believeAngle(bestAt(30.0), {.zero_rad = 100.0 * kDegree, .turn_sign = -1.0, .evidence = 60.0});
  EXPECT_NEAR(belief.angle_rad / kDegree, 70.0, 0.6);
}

TEST(StateBelief, LessEvidenceIsLessSure) {
  const AngleBelief much = believeAngle(bestAt(50.0), {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 60.0});
  const AngleBelief little = believeAngle(bestAt(50.0), {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 4.0});
  EXPECT_GT(little.sigma_rad, 3.0 * much.sigma_rad);
}

TEST(StateBelief, NothingToSeeIsAsLikelyEverywhere) {
  const AngleBelief belief = believeAngle(std::vector<double>(72, 0.9), {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 60.0});
  EXPECT_NEAR(belief.sigma_rad, std::numbers::pi / std::sqrt(3.0), 0.02);  // of an even density
  for (const double probability : believeStates(belief, nine(), {})) {
    EXPECT_NEAR(probability, 0.98 / 9.0, 1e-3);
  }
}

TEST(StateBelief, AKnobAtAStateIsInIt) {
  const AngleBelief belief = believeAngle(bestAt(122.0), {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 60.0});
  const std::vector<double> probabilities = believeStates(belief, nine(), {});
  EXPECT_GT(probabilities[3], 0.99);
}

TEST(StateBelief, AKnobHalfWayIsInNone) {
  const AngleBelief belief = believeAngle(bestAt(140.0), {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 200.0});
  const std::vector<double> probabilities = believeStates(belief, nine(), {});
  EXPECT_LT(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 0.3);
}

TEST(StateBelief, TwoAnglesThatFitAlikeShareTheProbability) {
  std::vector<double> unexplained = bestAt(80.0);
  const std::vector<double> other = bestAt(240.0);
  for (std::size_t i = 0; i < unexplained.size(); ++i) {
    unexplained[i] = std::min(unexplained[i], other[i]);
  }
  const std::vector<double> probabilities =
      believeStates(believeAngle(unexplained, {.zero_rad = 0.0, .turn_sign = 1.0, .evidence = 60.0}), nine(), {});
  EXPECT_NEAR(probabilities[2], 0.5, 0.01);
  EXPECT_NEAR(probabilities[6], 0.5, 0.01);
}

TEST(StateBelief, WithoutStatesThereIsNone) {
  EXPECT_TRUE(believeStates(believeAngle(bestAt(10.0), {}), {}, {}).empty());
}

}  // namespace
}  // namespace oikos::recognition
