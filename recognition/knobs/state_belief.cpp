// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/state_belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace oikos::recognition {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kDegrees = 360;
constexpr double kStep_rad = kTurn / kDegrees;

/// Through four values a step apart, at `t` from the second to the third (Catmull & Rom 1974).
double interpolate(const std::array<double, 4>& values, double t) {
  const double a = -0.5 * values[0] + 1.5 * values[1] - 1.5 * values[2] + 0.5 * values[3];
  const double b = values[0] - 2.5 * values[1] + 2.0 * values[2] - 0.5 * values[3];
  const double c = 0.5 * (values[2] - values[0]);
  return ((a * t + b) * t + c) * t + values[1];
}

double valueAt(const std::vector<double>& around, double index) {
  const auto count = static_cast<int>(around.size());
  const double floor = std::floor(index);
  std::array<double, 4> values{};
  for (int i = 0; i < 4; ++i) {
    const int wrapped = ((static_cast<int>(floor) + i - 1) % count + count) % count;
    values[static_cast<std::size_t>(i)] = around[static_cast<std::size_t>(wrapped)];
  }
  return interpolate(values, index - floor);
}

}  // namespace

AngleBelief believeAngle(const std::vector<double>& unexplained, const BeliefRule& rule) {
  std::vector<double> log_likelihood;
  for (const double share : unexplained) {
    log_likelihood.push_back(-0.5 * rule.evidence * std::log(share));
  }
  AngleBelief belief;
  const double per_step = static_cast<double>(unexplained.size()) / kTurn;
  for (int degree = 0; degree < kDegrees; ++degree) {
    const double index = rule.turn_sign * (degree * kStep_rad - rule.zero_rad) * per_step;
    belief.density.push_back(valueAt(log_likelihood, index));
  }
  const auto best = std::max_element(belief.density.begin(), belief.density.end());
  const double greatest = *best;
  const auto middle = static_cast<int>(best - belief.density.begin());
  double sum = 0.0;
  for (double& value : belief.density) {
    value = std::exp(value - greatest);
    sum += value;
  }
  // The likeliest whole degree, then the mean of what is near it.
  double weight = 0.0;
  double offset = 0.0;
  double squares = 0.0;
  constexpr int kNear = 8;
  for (int i = -kDegrees / 2; i < kDegrees / 2; ++i) {
    double& value = belief.density[static_cast<std::size_t>((middle + i + kDegrees) % kDegrees)];
    value /= sum;
    squares += value * i * i * kStep_rad * kStep_rad;
    if (std::abs(i) <= kNear) {
      weight += value;
      offset += value * i * kStep_rad;
    }
  }
  belief.angle_rad = std::fmod(middle * kStep_rad + offset / weight + kTurn, kTurn);
  belief.sigma_rad = std::sqrt(squares + kStep_rad * kStep_rad / 12.0);
  return belief;
}

std::vector<double> believeStates(const AngleBelief& belief, const std::vector<model::ModelKnobState>& states, const StateRule& rule) {
  const double norm = 1.0 / (std::sqrt(kTurn) * rule.detent_sigma_rad);
  std::vector<double> probabilities;
  double sum = rule.between_share / kTurn;
  for (const model::ModelKnobState& state : states) {
    double likelihood = 0.0;
    for (int degree = 0; degree < kDegrees; ++degree) {
      const double off = std::remainder(degree * kStep_rad - state.angle_rad, kTurn) / rule.detent_sigma_rad;
      likelihood += belief.density[static_cast<std::size_t>(degree)] * norm * std::exp(-0.5 * off * off);
    }
    probabilities.push_back(likelihood * (1.0 - rule.between_share) / static_cast<double>(states.size()));
    sum += probabilities.back();
  }
  for (double& probability : probabilities) {
    probability /= sum;
  }
  return probabilities;
}

}  // namespace oikos::recognition
