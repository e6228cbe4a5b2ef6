// SPDX-License-Identifier: Apache-2.0
#include "registration/pose_search.h"

#include <algorithm>
#include <numbers>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::registration {

namespace {

struct Hypothesis {
  AlignResult result;
  std::vector<double> state;
  Eigen::Isometry3d T_map_moving = Eigen::Isometry3d::Identity();
};

/// By what it explains of the scan, outlines included: a table top that slid along itself is where a table top is.
double scoreOf(const AlignResult& result) {
  constexpr double kOutline = 0.3;
  return result.fit + kOutline * result.outline;
}

bool isUsable(const AlignResult& result) {
  return result.status != AlignStatus::kNotInView && result.status != AlignStatus::kTooLittleOverlap;
}

/// Steps from the middle to each start: turns, and shifts across the line of sight and along it.
std::vector<Step> startsAbout(const Motion& motion, const SearchConfig& config) {
  const Eigen::Vector3d sight = motion.pivot_map() - motion.T_map_camera().translation();
  const Eigen::Vector3d ahead = sight.norm() > 0.3 ? sight : Eigen::Vector3d(motion.T_map_camera().linear().col(2));
  const Eigen::Vector2d across = Eigen::Vector2d(-ahead.y(), ahead.x()).normalized();
  std::vector<Step> starts;
  const Eigen::Vector2d along(across.y(), -across.x());
  for (const double sideways : {0.0, -0.6, 0.6}) {
    for (const double farther : {0.0, -0.6, 0.6}) {
      for (const double turn : {0.0, -0.6, 0.6}) {
        Step step = Step::Zero(motion.dimension());
        step.head<2>() = config.range_m * (sideways * across + farther * along);
        step[2] = turn * config.range_deg * std::numbers::pi / 180.0;
        starts.push_back(step);
      }
    }
  }
  return starts;
}

class Search {
 public:
  Search(Motion& motion, const Scan& scan, const SearchConfig& config) : motion_(motion), scan_(scan), config_(config) {}

  AlignResult run() {
    const std::vector<double> middle = motion_.saved();
    T_map_middle_ = motion_.T_map_moving();
    pivot_moving_ = T_map_middle_.inverse() * motion_.pivot_map();
    const Hypothesis first = alignedFrom(middle, scan_, config_.align);
    const bool is_near = first.result.moved_m <= config_.near_m && first.result.moved_rad <= config_.near_deg * std::numbers::pi / 180.0;
    if (first.result.status == AlignStatus::kConverged && is_near && first.result.fit >= config_.good_fit) {
      return first.result;
    }
    std::vector<Hypothesis> found = screened(middle);
    for (Hypothesis& hypothesis : found) {
      hypothesis = alignedFrom(hypothesis.state, scan_, config_.align);
    }
    if (isWithinRange(first)) {
      found.insert(found.begin(), first);
    }
    std::erase_if(found, [&](const Hypothesis& h) { return !isWithinRange(h); });
    if (std::any_of(found.begin(), found.end(), [&](const Hypothesis& h) { return isItself(h); })) {
      std::erase_if(found, [&](const Hypothesis& h) { return !isItself(h); });
    }
    if (found.empty()) {
      return nothingFound(middle);
    }
    return theBest(found);
  }

 private:
  Hypothesis alignedFrom(const std::vector<double>& state, const Scan& scan, const AlignConfig& config) {
    motion_.restore(state);
    Hypothesis hypothesis;
    hypothesis.result = align(motion_, scan, config);
    hypothesis.state = motion_.saved();
    hypothesis.T_map_moving = motion_.T_map_moving();
    return hypothesis;
  }

  /// The best of all starts after a few steps on very few points.
  std::vector<Hypothesis> screened(const std::vector<double>& middle) {
    constexpr int kThinning = 4;
    AlignConfig quick = config_.align;
    quick.coarse_iterations = config_.screening_iterations;
    quick.fine_iterations = 1;
    quick.min_inliers = std::max(6, quick.min_inliers / (kThinning * kThinning));
    const Scan thin = thinned(scan_, kThinning);
    motion_.restore(middle);
    const std::vector<Step> starts = startsAbout(motion_, config_);
    std::vector<Hypothesis> found;
    for (const Step& start : starts) {
      motion_.restore(middle);
      motion_.apply(start);
      const Hypothesis hypothesis = alignedFrom(motion_.saved(), thin, quick);
      const bool is_new = std::none_of(found.begin(), found.end(), [&](const Hypothesis& other) { return isSame(other, hypothesis); });
      if (isUsable(hypothesis.result) && isWithinRange(hypothesis) && is_new) {
        found.push_back(hypothesis);
      }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Hypothesis& a, const Hypothesis& b) { return scoreOf(a.result) > scoreOf(b.result); });
    found.resize(std::min(found.size(), static_cast<std::size_t>(config_.best_starts)));
    return found;
  }

  /// What there is lies beyond where the model may be.
  AlignResult nothingFound(const std::vector<double>& middle) {
    motion_.restore(middle);
    AlignResult result = judge(motion_, scan_, config_.align);
    if (isUsable(result)) {
      result.status = AlignStatus::kTooLittleOverlap;
    }
    return result;
  }

  AlignResult theBest(const std::vector<Hypothesis>& found) {
    const auto best = std::max_element(found.begin(), found.end(), [](const Hypothesis& a, const Hypothesis& b) {
      return std::pair(isUsable(a.result), scoreOf(a.result)) < std::pair(isUsable(b.result), scoreOf(b.result));
    });
    motion_.restore(best->state);
    AlignResult result = best->result;
    const bool rivalled = std::any_of(found.begin(), found.end(), [&](const Hypothesis& other) {
      return isUsable(other.result) && scoreOf(other.result) > scoreOf(best->result) - config_.clear_lead && !isSame(other, *best);
    });
    if (rivalled && result.status == AlignStatus::kConverged) {
      result.status = AlignStatus::kAmbiguous;
    }
    if (result.status == AlignStatus::kConverged && !isItself(*best)) {
      result.status = AlignStatus::kTooLittleOverlap;
    }
    return result;
  }

  [[nodiscard]] bool isItself(const Hypothesis& hypothesis) const { return hypothesis.result.overlap >= config_.min_overlap; }

  /// A piece that looks the same from another side must not be found turned round.
  [[nodiscard]] bool isWithinRange(const Hypothesis& hypothesis) const {
    constexpr double kBeyond = 1.7;  // the corner of the range, and a little
    const double moved_m = (hypothesis.T_map_moving * pivot_moving_ - T_map_middle_ * pivot_moving_).norm();
    const double turned_rad = Eigen::AngleAxisd(T_map_middle_.linear().transpose() * hypothesis.T_map_moving.linear()).angle();
    return moved_m <= kBeyond * config_.range_m && turned_rad <= kBeyond * config_.range_deg * std::numbers::pi / 180.0;
  }

  [[nodiscard]] bool isSame(const Hypothesis& a, const Hypothesis& b) const {
    const Eigen::Isometry3d T_a_b = a.T_map_moving.inverse() * b.T_map_moving;
    return T_a_b.translation().norm() < config_.same_m &&
           Eigen::AngleAxisd(T_a_b.linear()).angle() < config_.same_deg * std::numbers::pi / 180.0;
  }

  Motion& motion_;
  const Scan& scan_;
  const SearchConfig& config_;
  Eigen::Isometry3d T_map_middle_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d pivot_moving_ = Eigen::Vector3d::Zero();
};

}  // namespace

std::vector<std::string> SearchConfig::validate() const {
  return base::ConfigRules()
      .atLeast("range_m", range_m, 0.0)
      .atLeast("range_deg", range_deg, 0.0)
      .between("good_fit", good_fit, 0.0, 1.0)
      .atLeast("near_m", near_m, 0.0)
      .atLeast("near_deg", near_deg, 0.0)
      .atLeast("screening_iterations", screening_iterations, 1)
      .atLeast("best_starts", best_starts, 1)
      .atLeast("same_m", same_m, 0.0)
      .atLeast("same_deg", same_deg, 0.0)
      .between("min_overlap", min_overlap, 0.0, 1.0)
      .atLeast("clear_lead", clear_lead, 0.0)
      .messages();
}

AlignResult searchPose(Motion& motion, const Scan& scan, const SearchConfig& config) {
  OIKOS_CHECK(motion.dimension() >= 3 && motion.freedoms()[2].name == "yaw");
  return Search(motion, scan, config).run();
}

}  // namespace oikos::registration
