// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "registration/articulated/joint_values.h"

namespace oikos::registration {

JointSearch::JointSearch(const JointTree& tree, const ArticulatedConfig& config, LinkLayers& layers, const Standing& believed)
    : tree_(tree),
      config_(config),
      layers_(layers),
      believed_(believed),
      findings_{{believed, std::vector<Eigen::Vector3d>(tree.links().size(), Eigen::Vector3d::Zero())},
                std::vector<JointEvidence>(tree.links().size()),
                std::vector<JointSight>(tree.links().size())} {
  for (const int link : movable()) {
    listValues(link);
    const std::vector<double>& values = findings_.evidence[static_cast<std::size_t>(link)].values;
    valueOf(link) = std::clamp(valueOf(link), values.front(), values.back());
  }
}

std::vector<int> JointSearch::movable() const {
  std::vector<int> links;
  for (std::size_t link = 1; link < tree_.links().size(); ++link) {
    links.push_back(static_cast<int>(link));
  }
  return links;
}

double& JointSearch::valueOf(int link) {
  return findings_.estimates.standing.joint_values[static_cast<std::size_t>(tree_.links()[static_cast<std::size_t>(link)].joint)];
}

void JointSearch::listValues(int link) {
  layers_.pose(tree_.partPoses(believed_.joint_values), false);
  const model::ModelJoint& joint = tree_.jointOf(link);
  JointEvidence& evidence = findings_.evidence[static_cast<std::size_t>(link)];
  evidence.is_turn = joint.type == model::MotionType::kRevolute;
  const double unlimited = evidence.is_turn ? std::numbers::pi : config_.unlimited_m;
  evidence.values = valuesToLookAt(joint, valueOf(link), unlimited, config_.stride_m / std::max(0.05, layers_.lever(link)));
}

PixelWindow JointSearch::windowOfAll(const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera) const {
  constexpr int kBetween = 4;
  std::vector<double> values = findings_.estimates.standing.joint_values;
  PixelWindow window;
  for (std::size_t link = 0; link < tree_.links().size(); ++link) {
    const std::vector<double>& range = findings_.evidence[link].values;
    const std::size_t last = range.empty() ? 0 : range.size() - 1;
    for (std::size_t k = 0; k <= (range.empty() ? 0 : kBetween); ++k) {
      if (!range.empty()) {
        values[static_cast<std::size_t>(tree_.links()[link].joint)] = range[last * k / kBetween];
      }
      const Eigen::Isometry3d T_map_link =
          findings_.estimates.standing.T_map_model * tree_.partPoses(values)[static_cast<std::size_t>(tree_.links()[link].parts.front())];
      window = window.united(windowAround(layers_.ownBox(static_cast<int>(link)), T_map_camera.inverse() * T_map_link, camera));
    }
  }
  return window;
}

void JointSearch::lookForJoints(JointProfiler& profiler) {
  profiler.stand(findings_.estimates.standing, JointProfiler::Others::kBaseOnly, config_.coarse_sigma_m);
  for (std::size_t link = 1; link < tree_.links().size(); ++link) {
    if (tree_.links()[link].parent != 0) {
      profiler.stand(findings_.estimates.standing, JointProfiler::Others::kBaseOnly, config_.coarse_sigma_m);
    }
    fillProfile(profiler, static_cast<int>(link));
    valueOf(static_cast<int>(link)) = bestValue(static_cast<int>(link));
  }
}

void JointSearch::settleRivals(JointProfiler& profiler, JointSolver& solver) {
  for (const int link : movable()) {
    const std::vector<double> starts =
        localMaxima(findings_.evidence[static_cast<std::size_t>(link)], config_.rival_share, config_.most_rivals);
    if (starts.size() < 2) {
      continue;
    }
    profiler.stand(findings_.estimates.standing, JointProfiler::Others::kBaseOnly, config_.fine_sigma_m);
    profiler.choose(link);
    double best = -std::numeric_limits<double>::infinity();
    double best_value = valueOf(link);
    const JointEstimates before = findings_.estimates;
    for (const double start : starts) {
      findings_.estimates = before;
      valueOf(link) = start;
      solver.solve(findings_.estimates, {.base = false, .links = {link}});
      const double score = profiler.score(valueOf(link), findings_.estimates.shift_map[static_cast<std::size_t>(link)]).log_likelihood;
      if (score > best) {
        best = score;
        best_value = valueOf(link);
      }
    }
    findings_.estimates = before;
    valueOf(link) = best_value;
  }
}

void JointSearch::solveAll(JointSolver& solver) {
  solver.solve(findings_.estimates, {.base = true, .links = {}});
  for (const int link : movable()) {
    solver.solve(findings_.estimates, {.base = false, .links = {link}});
  }
  if (config_.order == SolveOrder::kTogether) {
    solver.solve(findings_.estimates, {.base = true, .links = movable()});
  }
}

bool JointSearch::compareAgain(JointProfiler& profiler) {
  constexpr double kBetter = 1.0;
  bool has_moved = false;
  profiler.stand(findings_.estimates.standing, JointProfiler::Others::kAll, config_.fine_sigma_m);
  for (const int link : movable()) {
    JointEvidence& evidence = findings_.evidence[static_cast<std::size_t>(link)];
    fillProfile(profiler, link);
    evidence.has_peak = true;
    evidence.value = valueOf(link);
    const Eigen::Vector3d& shift = findings_.estimates.shift_map[static_cast<std::size_t>(link)];
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

void JointSearch::fillProfile(JointProfiler& profiler, int link) {
  JointEvidence& evidence = findings_.evidence[static_cast<std::size_t>(link)];
  profiler.choose(link);
  evidence.log_likelihood.clear();
  findings_.sights[static_cast<std::size_t>(link)].is_ever_seen = false;
  for (const double value : evidence.values) {
    const ValueScore score = profiler.score(value);
    evidence.log_likelihood.push_back(config_.profile_tempering * score.log_likelihood);
    findings_.sights[static_cast<std::size_t>(link)].is_ever_seen |= score.pixels > 0;
  }
}

double JointSearch::bestValue(int link) {
  constexpr double kEqual = 0.5;
  const JointEvidence& evidence = findings_.evidence[static_cast<std::size_t>(link)];
  const auto best = std::max_element(evidence.log_likelihood.begin(), evidence.log_likelihood.end());
  const double believed = valueOf(link);
  const double position = (believed - evidence.values.front()) / (evidence.values[1] - evidence.values[0]);
  const auto nearest = static_cast<std::size_t>(std::clamp(std::round(position), 0.0, static_cast<double>(evidence.values.size() - 1)));
  return evidence.log_likelihood[nearest] > *best - kEqual
             ? believed
             : evidence.values[static_cast<std::size_t>(best - evidence.log_likelihood.begin())];
}

}  // namespace oikos::registration
