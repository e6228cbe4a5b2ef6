// SPDX-License-Identifier: Apache-2.0
// The generalised likelihood ratio for one change at an unknown time (Hinkley, "Inference about the change-point in a sequence of random
// variables", 1970, doi:10.1093/biomet/57.1.1): the change is where the sum of log odds of the old state over the images before it, and of
// the new one over those from it on, is greatest. Differs in that the new state is a mixture: most joints take a second or two to get
// there.
#include "registration/articulated/joint_moment.h"

#include <algorithm>
#include <cmath>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "registration/articulated/joint_chances.h"

namespace oikos::registration {

namespace {

constexpr double kTelling = 1.0;  // log odds: less is hearsay

/// Mean chance of some bins.
class MeanChance {
 public:
  void add(double log_chance) {
    sum_ += std::exp(log_chance);
    ++count_;
  }
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }
  [[nodiscard]] double mean() const { return sum_ / count_; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

double oddsOf(const JointSighting& sighting, const JointStep& step, const JointFusionConfig& config) {
  const JointBins bins = binsOf(sighting.evidence, config);
  const std::vector<double> log_chances = logChances(bins, sighting, config);
  const double same = sighting.evidence.is_turn ? config.decision.window_deg * base::kRadPerDeg : config.decision.window_m;
  const double window = std::max(bins.width, std::min(same, std::abs(step.after - step.before) / 3.0));
  const double low = std::min(step.before, step.after);
  const double high = std::max(step.before, step.after);
  MeanChance before;
  MeanChance after;
  MeanChance between;
  for (std::size_t i = 0; i < bins.count; ++i) {
    const double value = bins.at(i);
    if (std::abs(value - step.before) <= window) {
      before.add(log_chances[i]);
    } else if (std::abs(value - step.after) <= window) {
      after.add(log_chances[i]);
    } else if (value > low && value < high) {
      between.add(log_chances[i]);
    }
  }
  if (before.isEmpty() || after.isEmpty()) {
    return 0.0;
  }
  const double gone = between.isEmpty() ? after.mean() : 0.5 * (after.mean() + between.mean());
  const double odds = std::log(gone / before.mean());
  return std::abs(odds) < kTelling ? 0.0 : odds;
}

}  // namespace

std::vector<double> stepOdds(const std::vector<JointSighting>& sightings, const JointStep& step, const JointFusionConfig& config) {
  OIKOS_CHECK(config.validate().empty() && config.decision.validate().empty() && step.before != step.after);
  std::vector<double> odds;
  odds.reserve(sightings.size());
  for (const JointSighting& sighting : sightings) {
    odds.push_back(seesJoint(sighting) ? oddsOf(sighting, step, config) : 0.0);
  }
  return odds;
}

std::optional<JointMoment> findMoment(const std::vector<JointSighting>& sightings, const JointStep& step, const JointFusionConfig& config) {
  const std::vector<double> odds = stepOdds(sightings, step, config);
  std::optional<JointMoment> moment;
  double sum = 0.0;  // over the images before
  double least = 0.0;
  for (std::size_t i = 0; i < odds.size(); ++i) {
    if (odds[i] > 0.0 && (!moment || sum < least)) {
      moment = JointMoment{i, std::nullopt};
      least = sum;
    }
    sum += odds[i];
  }
  if (!moment || sum <= least) {
    return std::nullopt;
  }
  for (std::size_t i = moment->first_after; i > 0 && !moment->last_before; --i) {
    if (odds[i - 1] < 0.0) {
      moment->last_before = i - 1;
    }
  }
  return moment;
}

}  // namespace oikos::registration
