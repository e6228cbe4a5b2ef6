// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_chances.h"

#include <algorithm>
#include <cmath>

#include "core/base/degrees.h"

namespace oikos::registration {

namespace {

/// The profile between its values, not normalised.
std::vector<double> profileOver(const JointBins& bins, const JointEvidence& evidence) {
  const double best = *std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
  const double stride = evidence.values[1] - evidence.values[0];
  std::vector<double> density(bins.count);
  for (std::size_t i = 0; i < bins.count; ++i) {
    const double place = std::clamp((bins.at(i) - evidence.values.front()) / stride, 0.0, static_cast<double>(evidence.values.size() - 1));
    const auto below = std::min(static_cast<std::size_t>(place), evidence.values.size() - 2);
    const double share = place - static_cast<double>(below);
    const double log_likelihood = (1.0 - share) * evidence.log_likelihood[below] + share * evidence.log_likelihood[below + 1];
    density[i] = std::exp(log_likelihood - best);
  }
  return density;
}

void normalise(std::vector<double>& density) {
  double sum = 0.0;
  for (const double value : density) {
    sum += value;
  }
  for (double& value : density) {
    value /= sum;
  }
}

}  // namespace

JointBins binsOf(const JointEvidence& evidence, const JointFusionConfig& config) {
  const double range = evidence.values.back() - evidence.values.front();
  const double width = evidence.is_turn ? config.bin_deg * base::kRadPerDeg : config.bin_m;
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(range / width)));
  return {evidence.values.front(), range / static_cast<double>(steps), steps + 1};
}

bool seesJoint(const JointSighting& sighting) {
  return sighting.status != JointStatus::kNotInView && !sighting.evidence.log_likelihood.empty();
}

std::vector<double> logChances(const JointBins& bins, const JointSighting& sighting, const JointFusionConfig& config) {
  const JointEvidence& evidence = sighting.evidence;
  std::vector<double> chance = profileOver(bins, evidence);
  normalise(chance);
  const bool is_found = sighting.status == JointStatus::kFound;
  if (is_found) {
    const double variance = evidence.variance + bins.width * bins.width / 12.0;
    std::vector<double> peak(bins.count);
    for (std::size_t i = 0; i < bins.count; ++i) {
      const double off = bins.at(i) - evidence.value;
      peak[i] = std::exp(-0.5 * off * off / variance);
    }
    normalise(peak);
    for (std::size_t i = 0; i < bins.count; ++i) {
      chance[i] = sighting.confidence * peak[i] + (1.0 - sighting.confidence) * chance[i];
    }
  }
  const double misread = is_found ? config.misread : config.misread_unsure;
  for (double& value : chance) {
    value = std::log((1.0 - misread) * value + misread / static_cast<double>(bins.count));
  }
  return chance;
}

}  // namespace oikos::registration
