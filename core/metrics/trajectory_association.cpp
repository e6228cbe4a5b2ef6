// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/trajectory_association.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <tuple>

namespace oikos::metrics {

namespace {

using recording::StampedPose;
using recording::Trajectory;

constexpr std::int64_t kSpanSlack_ns = 1'000'000;

Trajectory sortedFinite(const Trajectory& trajectory) {
  Trajectory sorted;
  std::copy_if(trajectory.begin(), trajectory.end(), std::back_inserter(sorted),
               [](const StampedPose& pose) { return pose.T_map_camera.matrix().allFinite(); });
  std::stable_sort(sorted.begin(), sorted.end(), [](const StampedPose& a, const StampedPose& b) { return a.stamp_ns < b.stamp_ns; });
  return sorted;
}

Trajectory::const_iterator firstAtOrAfter(const Trajectory& trajectory, std::int64_t stamp_ns) {
  return std::lower_bound(trajectory.begin(), trajectory.end(), stamp_ns,
                          [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
}

Eigen::Isometry3d interpolated(const StampedPose& before, const StampedPose& after, std::int64_t stamp_ns) {
  const std::int64_t gap_ns = std::max<std::int64_t>(after.stamp_ns - before.stamp_ns, 1);
  const double share = std::clamp(static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(gap_ns), 0.0, 1.0);
  const Eigen::Quaterniond q_before(before.T_map_camera.linear());
  const Eigen::Quaterniond q_after(after.T_map_camera.linear());
  Eigen::Isometry3d T_truth_camera = Eigen::Isometry3d::Identity();
  T_truth_camera.linear() = q_before.slerp(share, q_after).toRotationMatrix();
  T_truth_camera.translation() = (1.0 - share) * before.T_map_camera.translation() + share * after.T_map_camera.translation();
  return T_truth_camera;
}

std::vector<PosePair> associateInterpolated(const Trajectory& estimate, const Trajectory& truth, std::int64_t max_difference_ns) {
  std::vector<PosePair> pairs;
  for (const StampedPose& pose : estimate) {
    const std::int64_t stamp_ns = pose.stamp_ns;
    if (stamp_ns < truth.front().stamp_ns - kSpanSlack_ns || stamp_ns > truth.back().stamp_ns + kSpanSlack_ns) {
      continue;
    }
    const auto found = firstAtOrAfter(truth, stamp_ns);
    const StampedPose& after = found == truth.end() ? truth.back() : *found;
    const StampedPose& before = found == truth.begin() ? truth.front() : *std::prev(found);
    if (std::min(std::abs(after.stamp_ns - stamp_ns), std::abs(before.stamp_ns - stamp_ns)) < max_difference_ns) {
      pairs.push_back({stamp_ns, pose.T_map_camera, interpolated(before, after, stamp_ns)});
    }
  }
  return pairs;
}

struct Candidate {
  std::int64_t difference_ns = 0;
  std::size_t estimate = 0;
  std::size_t truth = 0;
};

std::vector<Candidate> candidatesBySmallestDifference(const Trajectory& estimate, const Trajectory& truth, std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const std::int64_t stamp_ns = estimate[i].stamp_ns;
    const auto begin = firstAtOrAfter(truth, stamp_ns - max_difference_ns + 1);
    for (auto it = begin; it != truth.end() && it->stamp_ns < stamp_ns + max_difference_ns; ++it) {
      candidates.push_back({std::abs(it->stamp_ns - stamp_ns), i, static_cast<std::size_t>(it - truth.begin())});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.difference_ns, a.estimate, a.truth) < std::tie(b.difference_ns, b.estimate, b.truth);
  });
  return candidates;
}

std::vector<PosePair> associateNearest(const Trajectory& estimate, const Trajectory& truth, std::int64_t max_difference_ns) {
  std::vector<bool> estimate_used(estimate.size(), false);
  std::vector<bool> truth_used(truth.size(), false);
  std::vector<PosePair> pairs;
  for (const Candidate& candidate : candidatesBySmallestDifference(estimate, truth, max_difference_ns)) {
    if (!estimate_used[candidate.estimate] && !truth_used[candidate.truth]) {
      estimate_used[candidate.estimate] = true;
      truth_used[candidate.truth] = true;
      const StampedPose& pose = estimate[candidate.estimate];
      pairs.push_back({pose.stamp_ns, pose.T_map_camera, truth[candidate.truth].T_map_camera});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const PosePair& a, const PosePair& b) { return a.stamp_ns < b.stamp_ns; });
  return pairs;
}

}  // namespace

std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& truth, Association association,
                                std::int64_t max_difference_ns) {
  const Trajectory sorted_estimate = sortedFinite(estimate);
  const Trajectory sorted_truth = sortedFinite(truth);
  if (sorted_estimate.empty() || sorted_truth.empty()) {
    return {};
  }
  return association == Association::kNearest ? associateNearest(sorted_estimate, sorted_truth, max_difference_ns)
                                              : associateInterpolated(sorted_estimate, sorted_truth, max_difference_ns);
}

}  // namespace oikos::metrics
