// SPDX-License-Identifier: Apache-2.0
// Optimal partitioning (Jackson et al., "An algorithm for optimal partitioning of data on an interval", 2005, doi:10.1109/LSP.2001.838216)
// of the generalised likelihood ratio: a span costs what its best single value leaves unexplained, and a change has its price. The
// likelihood of each image is a density over the joint's whole range, so the best value of a span is looked up, not searched. Images from
// one place repeat each other's errors: n of them count for n / (1 + (n - 1) * repeated). What contradicts a value is no such repetition.
#include "registration/articulated/joint_fusion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "registration/articulated/joint_chances.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Sums up images one after the other, those from one place for less than they are.
class SpanSum {
 public:
  SpanSum(std::size_t bins, double repeated) : total_(bins, 0.0), repeated_(repeated) {}

  void add(int view, const std::vector<double>& log_chances) {
    View& seen = views_.try_emplace(view, View{0, std::vector<double>(total_.size(), 0.0)}).first->second;
    const double before = weightOf(seen.count);
    ++seen.count;
    const double now = weightOf(seen.count);
    for (std::size_t i = 0; i < total_.size(); ++i) {
      total_[i] += (now - before) * seen.sum[i] + now * log_chances[i];
      seen.sum[i] += log_chances[i];
    }
  }

  /// By bin.
  [[nodiscard]] const std::vector<double>& total() const { return total_; }

 private:
  struct View {
    int count = 0;
    std::vector<double> sum;
  };
  [[nodiscard]] double weightOf(int count) const { return count == 0 ? 0.0 : 1.0 / (1.0 + (count - 1) * repeated_); }

  std::vector<double> total_;
  double repeated_;
  std::map<int, View> views_;
};

/// By sighting, a number that those from the same place share.
std::vector<int> viewsOf(const std::vector<JointSighting>& sightings, const JointFusionConfig& config) {
  std::vector<Eigen::Isometry3d> places;
  std::vector<int> views;
  for (const JointSighting& sighting : sightings) {
    const auto place = std::find_if(places.begin(), places.end(), [&](const Eigen::Isometry3d& T_map_place) {
      const Eigen::Isometry3d T_place_camera = T_map_place.inverse() * sighting.T_map_camera;
      return T_place_camera.translation().norm() < config.same_view_m &&
             Eigen::AngleAxisd(T_place_camera.linear()).angle() < config.same_view_deg * kDegree;
    });
    views.push_back(static_cast<int>(place - places.begin()));
    if (place == places.end()) {
      places.push_back(sighting.T_map_camera);
    }
  }
  return views;
}

/// What each image says for and against each bin, over one that says nothing. Images from one place repeat each other's errors in what they
/// say for a value, wherever the joint is moved between them; one that speaks against it repeats nothing, and counts in full.
std::vector<std::vector<double>> wordsOf(const std::vector<std::vector<double>>& log_chances, const std::vector<int>& views,
                                         const JointFusionConfig& config) {
  std::vector<std::vector<double>> words = log_chances;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto repeats = static_cast<double>(std::count(views.begin(), views.end(), views[i]) - 1);
    const double weight = 1.0 / (1.0 + repeats * config.repeated);
    const double uniform = -std::log(static_cast<double>(words[i].size()));
    for (double& word : words[i]) {
      const double gain = word - uniform;
      word = gain > 0.0 ? weight * gain : gain;
    }
  }
  return words;
}

/// The best spans up to an image.
struct BestEnd {
  double score = -std::numeric_limits<double>::infinity();
  std::size_t begin_of_last = 0;
};

/// Where spans begin, the first at 0.
std::vector<std::size_t> bestSplits(const std::vector<std::vector<double>>& log_chances, const std::vector<int>& views,
                                    const JointFusionConfig& config) {
  const std::vector<std::vector<double>> words = wordsOf(log_chances, views, config);
  const std::size_t count = words.size();
  std::vector<BestEnd> best(count + 1);
  best[0].score = config.change_cost;  // the first span follows no change
  std::vector<double> sum;
  for (std::size_t begin = 0; begin < count; ++begin) {
    sum.assign(words[begin].size(), 0.0);
    for (std::size_t end = begin + 1; end <= count; ++end) {
      std::transform(sum.begin(), sum.end(), words[end - 1].begin(), sum.begin(), std::plus<>());
      const double score = best[begin].score - config.change_cost + *std::max_element(sum.begin(), sum.end());
      if (score > best[end].score) {
        best[end] = {score, begin};
      }
    }
  }
  std::vector<std::size_t> splits;
  for (std::size_t end = count; end > 0; end = best[end].begin_of_last) {
    splits.insert(splits.begin(), best[end].begin_of_last);
  }
  return splits;
}

/// Mean and spread about the best bin, and how much of the posterior lies there.
void conclude(const JointBins& bins, const std::vector<double>& total, const JointEvidence& evidence, const JointDecisionConfig& config,
              bool has_witness, JointSpan& span) {
  const auto best = static_cast<std::size_t>(std::max_element(total.begin(), total.end()) - total.begin());
  const double window = evidence.is_turn ? config.window_deg * kDegree : config.window_m;
  double all = 0.0;
  double near = 0.0;
  double first = 0.0;
  double second = 0.0;
  std::vector<char> likely(total.size(), 0);
  for (std::size_t i = 0; i < total.size(); ++i) {
    const double chance = std::exp(total[i] - total[best]);
    likely[i] = chance > 0.02 ? 1 : 0;
    all += chance;
    if (std::abs(bins.at(i) - bins.at(best)) <= window) {
      near += chance;
      first += chance * bins.at(i);
      second += chance * bins.at(i) * bins.at(i);
    }
  }
  span.value = first / near;
  span.variance = std::max(0.0, second / near - span.value * span.value) + evidence.shared_variance;
  span.confidence = near / all;
  const double max_sigma = evidence.is_turn ? config.max_sigma_deg * kDegree : config.max_sigma_m;
  const auto filled = static_cast<double>(std::count(likely.begin(), likely.end(), 1)) / static_cast<double>(likely.size());
  if (has_witness && span.confidence >= config.min_confidence && std::sqrt(span.variance) <= max_sigma) {
    span.status = JointStatus::kFound;
  } else {
    span.status = has_witness && filled <= config.max_spread ? JointStatus::kAmbiguous : JointStatus::kNotObservable;
  }
}

std::vector<JointSighting> seeing(const std::vector<JointSighting>& sightings, std::vector<std::size_t>& indices) {
  std::vector<JointSighting> kept;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    OIKOS_CHECK(i == 0 || sightings[i].stamp_ns >= sightings[i - 1].stamp_ns);
    if (seesJoint(sightings[i])) {
      OIKOS_CHECK(kept.empty() || sightings[i].evidence.values == kept.front().evidence.values);
      kept.push_back(sightings[i]);
      indices.push_back(i);
    }
  }
  return kept;
}

}  // namespace

std::vector<std::string> JointFusionConfig::validate() const {
  return base::ConfigRules()
      .between("repeated", repeated, 0.0, 1.0)
      .atLeast("same_view_m", same_view_m, 0.0)
      .atLeast("same_view_deg", same_view_deg, 0.0)
      .require(misread > 0.0 && misread < 1.0, "misread", misread, "must be > 0 and < 1")
      .require(misread_unsure > 0.0 && misread_unsure < 1.0, "misread_unsure", misread_unsure, "must be > 0 and < 1")
      .atLeast("change_cost", change_cost, 0.0)
      .greater("bin_deg", bin_deg, 0.0)
      .greater("bin_m", bin_m, 0.0)
      .messages();
}

std::vector<JointSpan> fuse(const std::vector<JointSighting>& sightings, const JointFusionConfig& config) {
  OIKOS_CHECK(config.validate().empty() && config.decision.validate().empty());
  std::vector<std::size_t> indices;
  const std::vector<JointSighting> kept = seeing(sightings, indices);
  if (kept.empty()) {
    return {};
  }
  const JointBins bins = binsOf(kept.front().evidence, config);
  std::vector<std::vector<double>> log_chances;
  log_chances.reserve(kept.size());
  for (const JointSighting& sighting : kept) {
    log_chances.push_back(logChances(bins, sighting, config));
  }
  const std::vector<int> views = viewsOf(kept, config);
  const std::vector<std::size_t> splits = bestSplits(log_chances, views, config);
  std::vector<JointSpan> spans;
  for (std::size_t k = 0; k < splits.size(); ++k) {
    const std::size_t end = k + 1 < splits.size() ? splits[k + 1] : kept.size();
    SpanSum sum(bins.count, config.repeated);
    bool has_witness = false;  // images that could not tell do not add up to one that can
    for (std::size_t i = splits[k]; i < end; ++i) {
      sum.add(views[i], log_chances[i]);
      has_witness |= kept[i].status == JointStatus::kFound || kept[i].status == JointStatus::kAmbiguous;
    }
    JointSpan span;
    span.first = indices[splits[k]];
    span.last = indices[end - 1];
    span.first_ns = kept[splits[k]].stamp_ns;
    span.last_ns = kept[end - 1].stamp_ns;
    conclude(bins, sum.total(), kept.front().evidence, config.decision, has_witness, span);
    spans.push_back(span);
  }
  return spans;
}

}  // namespace oikos::registration
