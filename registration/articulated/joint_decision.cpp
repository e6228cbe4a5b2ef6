// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_decision.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/config_rules.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLikely = 0.02;  // of the best value's posterior: what is less likely is out of the question

double bestOf(const JointEvidence& evidence) {
  const double best = *std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
  return evidence.has_peak ? std::max(best, evidence.peak_log_likelihood) : best;
}

/// Posterior within and beyond the window. The value's own cell stands in for the nearest one of the grid if it explains more.
double shareNear(const JointEvidence& evidence, double window) {
  const double best = bestOf(evidence);
  double near = evidence.has_peak ? std::exp(evidence.peak_log_likelihood - best) : 0.0;
  double far = 0.0;
  for (std::size_t i = 0; i < evidence.values.size(); ++i) {
    const double weight = std::exp(evidence.log_likelihood[i] - best);
    if (std::abs(evidence.values[i] - evidence.value) <= window) {
      near = std::max(near, weight);
    } else {
      far += weight;
    }
  }
  return near > 0.0 ? near / (near + far) : 0.0;
}

/// Whether what solving has led to explains the image, and about as well as the best of the values that were merely looked at.
bool isSummit(const JointEvidence& evidence) {
  constexpr double kLess = 2.0;
  constexpr double kLessShare = 0.5;
  constexpr double kGain = 1.0;  // over no such part
  const double best = *std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
  return evidence.has_peak && evidence.peak_log_likelihood > kGain &&
         evidence.peak_log_likelihood >= best - std::max(kLess, kLessShare * std::abs(best));
}

/// Runs of neighbouring values that are likely, and how much of the range they fill.
struct LikelyRuns {
  int count = 0;
  double share = 0.0;
};
LikelyRuns likelyRuns(const JointEvidence& evidence) {
  const double best = bestOf(evidence);
  LikelyRuns runs;
  bool was_likely = false;
  int likely = 0;
  for (const double log_likelihood : evidence.log_likelihood) {
    const bool is_likely = log_likelihood > best + std::log(kLikely);
    runs.count += is_likely && !was_likely ? 1 : 0;
    likely += is_likely ? 1 : 0;
    was_likely = is_likely;
  }
  runs.share = static_cast<double>(likely) / static_cast<double>(evidence.log_likelihood.size());
  return runs;
}

}  // namespace

std::vector<std::string> JointDecisionConfig::validate() const {
  base::ConfigRules rules;
  rules.greater("window_deg", window_deg, 0.0)
      .greater("window_m", window_m, 0.0)
      .between("min_confidence", min_confidence, 0.5, 1.0)
      .greater("max_sigma_deg", max_sigma_deg, 0.0)
      .greater("max_sigma_m", max_sigma_m, 0.0)
      .atLeast("min_agreeing", min_agreeing, 1)
      .between("min_share", min_share, 0.0, 1.0)
      .between("max_hidden", max_hidden, 0.0, 1.0)
      .between("max_spread", max_spread, 0.0, 1.0);
  return rules.messages();
}

JointDecision decide(const JointEvidence& evidence, const JointSight& sight, const JointDecisionConfig& config) {
  JointDecision decision;
  if (!sight.is_ever_seen || evidence.values.empty()) {
    return decision;
  }
  const double stride = evidence.values.size() > 1 ? evidence.values[1] - evidence.values[0] : 0.0;
  const double window = std::max(stride, evidence.is_turn ? config.window_deg * kDegree : config.window_m);
  const double max_sigma = evidence.is_turn ? config.max_sigma_deg * kDegree : config.max_sigma_m;
  decision.confidence = shareNear(evidence, window);
  const bool is_sharp = isSummit(evidence) && decision.confidence >= config.min_confidence && std::sqrt(evidence.variance) <= max_sigma;
  const bool is_shown =
      sight.agreeing >= config.min_agreeing && sight.agreeing >= config.min_share * static_cast<double>(sight.agreeing + sight.behind);
  const bool is_hidden =
      sight.read == 0 || sight.nearer > config.max_hidden * static_cast<double>(sight.agreeing + sight.nearer + sight.behind);
  const LikelyRuns runs = likelyRuns(evidence);
  if (is_hidden) {
    decision.status = JointStatus::kHidden;
  } else if (is_sharp && is_shown) {
    decision.status = JointStatus::kFound;
  } else if (runs.count > 1 && runs.share <= config.max_spread) {
    decision.status = JointStatus::kAmbiguous;
  } else {
    decision.status = JointStatus::kNotObservable;
  }
  return decision;
}

ProfileMoments momentsOf(const JointEvidence& evidence) {
  const double best = *std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
  double sum = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t i = 0; i < evidence.values.size(); ++i) {
    const double weight = std::exp(evidence.log_likelihood[i] - best);
    sum += weight;
    first += weight * evidence.values[i];
    second += weight * evidence.values[i] * evidence.values[i];
  }
  const double mean = first / sum;
  return {mean, std::max(0.0, second / sum - mean * mean)};
}

}  // namespace oikos::registration
