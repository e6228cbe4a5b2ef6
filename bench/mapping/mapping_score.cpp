// SPDX-License-Identifier: Apache-2.0
#include "bench/mapping/mapping_score.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/metrics/trajectory_association.h"

namespace oikos::bench {

namespace {

double largestErrorFirstAligned(const recording::Trajectory& estimate, const recording::Trajectory& truth) {
  constexpr std::int64_t kMaxDifference_ns = 20'000'000;
  const auto pairs = metrics::associate(estimate, truth, metrics::Association::kInterpolated, kMaxDifference_ns);
  double largest_m = 0.0;
  for (const metrics::PosePair& pair : pairs) {
    const Eigen::Isometry3d T_truth_estimate = pairs.front().T_truth_camera * pairs.front().T_estimate_camera.inverse();
    const Eigen::Vector3d position_truth = T_truth_estimate * pair.T_estimate_camera.translation();
    largest_m = std::max(largest_m, (position_truth - pair.T_truth_camera.translation()).norm());
  }
  return largest_m;
}

}  // namespace

MappingScore scoreRuns(const BenchRecording& recording, const std::vector<ChildRun>& runs, const std::filesystem::path& home) {
  const auto summary = nlohmann::json::parse(runs.back().out);
  const auto estimate = recording::readTrajectory(home / "map" / "trajectory.txt");
  MappingScore score;
  score.name = recording.name;
  score.frames = recording.frames;
  score.poses = static_cast<int>(estimate.size());
  score.lost = summary.at("lost_frames");
  score.keyframes = summary.at("keyframes");
  score.loops = summary.at("loops");
  score.error = metrics::evaluateTrajectory(estimate, recording.truth);
  score.first_aligned_max_m = largestErrorFirstAligned(estimate, recording.truth);
  score.cpu_s = runs.front().cpu_s;
  for (const ChildRun& run : runs) {
    score.wall_s.push_back(run.wall_s);
    score.cpu_s = std::min(score.cpu_s, run.cpu_s);
    score.peak_mb = std::max(score.peak_mb, run.peak_mb);
  }
  std::sort(score.wall_s.begin(), score.wall_s.end());
  return score;
}

}  // namespace oikos::bench
