// SPDX-License-Identifier: Apache-2.0
// After 5.2.1 of paper 003 (S227-S235): the base first, then each part as its joint allows. Differs in that a joint's start is not its
// closed state but the best of its whole range, since one freedom can be searched to the end; and that what cannot be told from here is
// said.
#include "registration/articulated/articulated_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "registration/articulated/joint_profile.h"
#include "registration/articulated/joint_values.h"
#include "registration/articulated/scan_window.h"

namespace oikos::registration {

namespace {

/// One registration.
class Run {
 public:
  Run(const JointTree& tree, const ArticulatedConfig& config, const PixelMixture& mixture, LinkLayers& layers, WholeModel& whole,
      const Eigen::Isometry3d& T_map_camera, const Standing& believed)
      : tree_(tree),
        config_(config),
        mixture_(mixture),
        layers_(layers),
        whole_(whole),
        T_map_camera_(T_map_camera),
        believed_(believed),
        estimates_{believed, std::vector<Eigen::Vector3d>(tree.links().size(), Eigen::Vector3d::Zero())},
        evidence_(tree.links().size()),
        sights_(tree.links().size()) {
    for (std::size_t link = 1; link < tree_.links().size(); ++link) {
      listValues(static_cast<int>(link));
      valueOf(static_cast<int>(link)) =
          std::clamp(valueOf(static_cast<int>(link)), evidence_[link].values.front(), evidence_[link].values.back());
    }
  }

  ArticulatedResult run(const Scan& whole_scan, const Surroundings& surroundings) {
    const PixelWindow window = windowOfAll(whole_scan.camera);
    if (window.isEmpty()) {
      SolverReport nothing;
      nothing.base_covariance = priorCovariance(config_.solver);
      return result(nothing);
    }
    const Scan scan = cropped(whole_scan, window);
    const Scan thin = thinned(scan, config_.coarse_thinning);
    const PixelBox box{window.left, window.top, window.left + window.width, window.top + window.height};
    JointProfiler profiler(tree_, layers_, thin, T_map_camera_, mixture_, thinned(cropped(surroundings, box), config_.coarse_thinning));
    JointSolver solver(tree_, whole_, scan, mixture_, config_.solver, T_map_camera_, believed_.T_map_model);
    lookForJoints(profiler);
    settleRivals(profiler, solver);
    solveAll(solver);
    if (compareAgain(profiler)) {
      solveAll(solver);
      compareAgain(profiler);
    }
    return result(solver.report(estimates_, {.base = true, .links = movable()}));
  }

 private:
  [[nodiscard]] std::vector<int> movable() const {
    std::vector<int> links;
    for (std::size_t link = 1; link < tree_.links().size(); ++link) {
      links.push_back(static_cast<int>(link));
    }
    return links;
  }

  double& valueOf(int link) {
    return estimates_.standing.joint_values[static_cast<std::size_t>(tree_.links()[static_cast<std::size_t>(link)].joint)];
  }

  void listValues(int link) {
    layers_.pose(tree_.partPoses(believed_.joint_values), false);
    const model::ModelJoint& joint = tree_.jointOf(link);
    JointEvidence& evidence = evidence_[static_cast<std::size_t>(link)];
    evidence.is_turn = joint.type == model::MotionType::kRevolute;
    const double unlimited = evidence.is_turn ? std::numbers::pi : config_.unlimited_m;
    evidence.values = valuesToLookAt(joint, valueOf(link), unlimited, config_.stride_m / std::max(0.05, layers_.lever(link)));
  }

  /// Where the piece can be seen, whatever its joints' values.
  [[nodiscard]] PixelWindow windowOfAll(const camera::PinholeCamera& camera) const {
    constexpr int kBetween = 4;
    std::vector<double> values = estimates_.standing.joint_values;
    PixelWindow window;
    for (std::size_t link = 0; link < tree_.links().size(); ++link) {
      const std::vector<double>& range = evidence_[link].values;
      const std::size_t last = range.empty() ? 0 : range.size() - 1;
      for (std::size_t k = 0; k <= (range.empty() ? 0 : kBetween); ++k) {
        if (!range.empty()) {
          values[static_cast<std::size_t>(tree_.links()[link].joint)] = range[last * k / kBetween];
        }
        const Eigen::Isometry3d T_map_link =
            estimates_.standing.T_map_model * tree_.partPoses(values)[static_cast<std::size_t>(tree_.links()[link].parts.front())];
        window = window.united(windowAround(layers_.ownBox(static_cast<int>(link)), T_map_camera_.inverse() * T_map_link, camera));
      }
    }
    return window;
  }

  /// Scores all values of a joint, the profiler standing ready.
  void fillProfile(JointProfiler& profiler, int link) {
    JointEvidence& evidence = evidence_[static_cast<std::size_t>(link)];
    profiler.choose(link);
    evidence.log_likelihood.clear();
    sights_[static_cast<std::size_t>(link)].is_ever_seen = false;
    for (const double value : evidence.values) {
      const ValueScore score = profiler.score(value);
      evidence.log_likelihood.push_back(config_.profile_tempering * score.log_likelihood);
      sights_[static_cast<std::size_t>(link)].is_ever_seen |= score.pixels > 0;
    }
  }

  /// Each joint by itself, as if no other part were there but the base: nothing is believed yet.
  void lookForJoints(JointProfiler& profiler) {
    profiler.stand(estimates_.standing, JointProfiler::Others::kBaseOnly, config_.coarse_sigma_m);
    for (std::size_t link = 1; link < tree_.links().size(); ++link) {
      if (tree_.links()[link].parent != 0) {
        profiler.stand(estimates_.standing, JointProfiler::Others::kBaseOnly, config_.coarse_sigma_m);
      }
      fillProfile(profiler, static_cast<int>(link));
      valueOf(static_cast<int>(link)) = bestValue(static_cast<int>(link));
    }
  }

  /// The most likely value; the believed one, where nothing speaks against it.
  [[nodiscard]] double bestValue(int link) {
    constexpr double kEqual = 0.5;
    const JointEvidence& evidence = evidence_[static_cast<std::size_t>(link)];
    const auto best = std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
    const double believed = valueOf(link);
    const double position = (believed - evidence.values.front()) / (evidence.values[1] - evidence.values[0]);
    const auto nearest = static_cast<std::size_t>(std::clamp(std::round(position), 0.0, static_cast<double>(evidence.values.size() - 1)));
    return evidence.log_likelihood[nearest] > *best - kEqual
               ? believed
               : evidence.values[static_cast<std::size_t>(best - evidence.log_likelihood.begin())];
  }

  /// Two values that explain the image about as well as long as both are only roughly right: each is solved for, and judged again.
  void settleRivals(JointProfiler& profiler, JointSolver& solver) {
    for (const int link : movable()) {
      const std::vector<double> starts = localMaxima(evidence_[static_cast<std::size_t>(link)], config_.rival_share, config_.most_rivals);
      if (starts.size() < 2) {
        continue;
      }
      profiler.stand(estimates_.standing, JointProfiler::Others::kBaseOnly, config_.fine_sigma_m);
      profiler.choose(link);
      double best = -std::numeric_limits<double>::infinity();
      double best_value = valueOf(link);
      const JointEstimates before = estimates_;
      for (const double start : starts) {
        estimates_ = before;
        valueOf(link) = start;
        solver.solve(estimates_, {.base = false, .links = {link}});
        const double score = profiler.score(valueOf(link), estimates_.shift_map[static_cast<std::size_t>(link)]).log_likelihood;
        if (score > best) {
          best = score;
          best_value = valueOf(link);
        }
      }
      estimates_ = before;
      valueOf(link) = best_value;
    }
  }

  void solveAll(JointSolver& solver) {
    solver.solve(estimates_, {.base = true, .links = {}});
    for (const int link : movable()) {
      solver.solve(estimates_, {.base = false, .links = {link}});
    }
    if (config_.order == SolveOrder::kTogether) {
      solver.solve(estimates_, {.base = true, .links = movable()});
    }
  }

  /// All values once more, with everything else where it was found. True if one of them is better than what was solved for.
  bool compareAgain(JointProfiler& profiler) {
    constexpr double kBetter = 1.0;
    bool has_moved = false;
    profiler.stand(estimates_.standing, JointProfiler::Others::kAll, config_.fine_sigma_m);
    for (const int link : movable()) {
      JointEvidence& evidence = evidence_[static_cast<std::size_t>(link)];
      fillProfile(profiler, link);
      evidence.has_peak = true;
      evidence.value = valueOf(link);
      const Eigen::Vector3d& shift = estimates_.shift_map[static_cast<std::size_t>(link)];
      evidence.peak_log_likelihood = config_.profile_tempering * profiler.score(evidence.value, shift).log_likelihood;
      const auto best = std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
      const double value = evidence.values[static_cast<std::size_t>(best - evidence.log_likelihood.begin())];
      const bool is_far = std::abs(value - evidence.value) > 1.5 * (evidence.values[1] - evidence.values[0]);
      if (is_far && *best > evidence.peak_log_likelihood + kBetter) {
        valueOf(link) = value;
        has_moved = true;
      }
    }
    return has_moved;
  }

  ArticulatedResult result(const SolverReport& report) {
    ArticulatedResult result;
    const Standing& standing = estimates_.standing;
    result.T_map_model = standing.T_map_model;
    result.covariance = report.base_covariance;
    result.base_counts = report.counts.empty() ? LinkCounts() : report.counts[0];
    result.rms_m = report.rms_m;
    result.status = statusOf(result.base_counts);
    for (const int link : movable()) {
      result.joints.push_back(estimateOf(link, report));
      if (hangsInTheAir(result.status, link, report) && result.joints.back().status == JointStatus::kFound) {
        result.joints.back().status = JointStatus::kNotObservable;
      }
    }
    result.joint_values = standing.joint_values;
    const std::vector<Eigen::Isometry3d> T_model_part = tree_.partPoses(standing.joint_values);
    for (const Eigen::Isometry3d& T : T_model_part) {
      result.T_map_part.push_back(standing.T_map_model * T);
    }
    for (JointEstimate& estimate : result.joints) {
      const model::ModelJoint& joint = tree_.model().joints[static_cast<std::size_t>(estimate.joint)];
      estimate.T_map_part = result.T_map_part[static_cast<std::size_t>(joint.child)];
      estimate.T_parent_part = result.T_map_part[static_cast<std::size_t>(joint.parent)].inverse() * estimate.T_map_part;
    }
    return result;
  }

  [[nodiscard]] BaseStatus statusOf(const LinkCounts& counts) const {
    const int speaking = counts.agreeing + counts.behind;
    if (speaking < config_.min_base_pixels) {
      return BaseStatus::kNotInView;
    }
    return counts.agreeing >= config_.min_base_share * speaking ? BaseStatus::kRegistered : BaseStatus::kNotThere;
  }

  /// The readings do not fit the base; or nobody has seen it, and to explain them, it was carried farther than it is likely to be off: it
  /// is a wall that looks like an open door.
  [[nodiscard]] bool hangsInTheAir(BaseStatus base, int link, const SolverReport& report) const {
    const double max_off_sq = config_.max_unseen_off * config_.max_unseen_off;
    return base == BaseStatus::kNotThere ||
           (base == BaseStatus::kNotInView && !report.off_prior.empty() && report.off_prior[static_cast<std::size_t>(link)] > max_off_sq);
  }

  JointEstimate estimateOf(int link, const SolverReport& report) {
    const auto index = static_cast<std::size_t>(link);
    JointEstimate estimate;
    estimate.joint = tree_.links()[index].joint;
    estimate.name = tree_.jointOf(link).name;
    JointEvidence& evidence = evidence_[index];
    JointSight& sight = sights_[index];
    if (!report.counts.empty()) {
      const LinkCounts& counts = report.counts[index];
      sight.read = counts.read;
      sight.agreeing = counts.agreeing;
      sight.nearer = counts.nearer;
      sight.behind = counts.behind;
      evidence.variance = report.variances[index];
      evidence.shared_variance = report.shared_variances[index];
    }
    const JointDecision decision = decide(evidence, sight, config_.decision);
    estimate.status = decision.status;
    estimate.confidence = decision.confidence;
    estimate.value = valueOf(link);
    const double range = evidence.values.back() - evidence.values.front();
    estimate.variance = decision.status == JointStatus::kFound ? evidence.variance
                        : sight.is_ever_seen                   ? momentsOf(evidence).variance + evidence.variance
                                                               : range * range / 12.0;
    estimate.evidence = evidence;
    estimate.sight = sight;
    return estimate;
  }

  const JointTree& tree_;
  const ArticulatedConfig& config_;
  const PixelMixture& mixture_;
  LinkLayers& layers_;
  WholeModel& whole_;
  Eigen::Isometry3d T_map_camera_;
  const Standing& believed_;
  JointEstimates estimates_;
  std::vector<JointEvidence> evidence_;  ///< by link
  std::vector<JointSight> sights_;
};

}  // namespace

std::vector<std::string> ArticulatedConfig::validate() const {
  return base::ConfigRules()
      .greater("stride_m", stride_m, 0.0)
      .atLeast("coarse_thinning", coarse_thinning, 1)
      .greater("coarse_sigma_m", coarse_sigma_m, 0.0)
      .greater("fine_sigma_m", fine_sigma_m, 0.0)
      .require(profile_tempering > 0.0 && profile_tempering <= 1.0, "profile_tempering", profile_tempering, "must be > 0 and <= 1")
      .atLeast("min_base_pixels", min_base_pixels, 1)
      .between("min_base_share", min_base_share, 0.0, 1.0)
      .greater("max_unseen_off", max_unseen_off, 0.0)
      .atLeast("most_rivals", most_rivals, 1)
      .between("rival_share", rival_share, 0.0, 1.0)
      .greater("unlimited_m", unlimited_m, 0.0)
      .atLeast("threads", threads, 1)
      .messages();
}

const JointEstimate* ArticulatedResult::find(const std::string& joint_name) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&](const JointEstimate& joint) { return joint.name == joint_name; });
  return found == joints.end() ? nullptr : &*found;
}

ArticulatedRegistration::ArticulatedRegistration(const model::ArticulatedModel& model, const ArticulatedConfig& config)
    : tree_(model), config_(config), mixture_(config.mixture), layers_(tree_, config.threads), whole_(tree_, config.threads) {
  OIKOS_CHECK(config.validate().empty() && config.mixture.validate().empty() && config.solver.validate().empty() &&
              config.decision.validate().empty());
}

ArticulatedResult ArticulatedRegistration::run(const Scan& scan, const Eigen::Isometry3d& T_map_camera, const Standing& believed) {
  OIKOS_CHECK(believed.joint_values.size() == tree_.model().joints.size());
  return Run(tree_, config_, mixture_, layers_, whole_, T_map_camera, believed).run(scan, {});
}

ArticulatedResult ArticulatedRegistration::run(const Scan& scan, const Eigen::Isometry3d& T_map_camera, const Standing& believed,
                                               const ImageContext& context) {
  OIKOS_CHECK(believed.joint_values.size() == tree_.model().joints.size() && context.base_sigma_m > 0.0 && context.base_sigma_deg > 0.0);
  ArticulatedConfig config = config_;
  config.solver.base_sigma_m = context.base_sigma_m;
  config.solver.base_sigma_deg = context.base_sigma_deg;
  return Run(tree_, config, mixture_, layers_, whole_, T_map_camera, believed).run(scan, context.surroundings);
}

}  // namespace oikos::registration
