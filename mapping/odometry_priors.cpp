// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry_priors.h"

#include <algorithm>

#include "core/geometry/se3.h"

namespace oikos::mapping {

OdometryPriors::OdometryPriors(std::optional<recording::Trajectory> T_odom_base, std::optional<Eigen::Isometry3d> T_base_camera) {
  if (!T_odom_base || !T_base_camera) {
    return;
  }
  odometry_ = std::move(*T_odom_base);
  for (recording::StampedPose& pose : odometry_) {
    pose.T_map_camera = pose.T_map_camera * *T_base_camera;
  }
}

std::optional<Eigen::Isometry3d> OdometryPriors::findCameraPose(std::int64_t stamp_ns) const {
  constexpr std::int64_t kMaxGap_ns = 500'000'000;
  const auto after =
      std::lower_bound(odometry_.begin(), odometry_.end(), stamp_ns, [](const auto& pose, std::int64_t t) { return pose.stamp_ns < t; });
  if (after == odometry_.end()) {
    return std::nullopt;
  }
  if (after->stamp_ns == stamp_ns) {
    return after->T_map_camera;
  }
  if (after == odometry_.begin() || after->stamp_ns - std::prev(after)->stamp_ns > kMaxGap_ns) {
    return std::nullopt;
  }
  const auto before = std::prev(after);
  const double fraction = static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(after->stamp_ns - before->stamp_ns);
  return geometry::interpolate(before->T_map_camera, after->T_map_camera, fraction);
}

std::vector<MotionPrior> OdometryPriors::betweenNodes(const KeyframeGraph& graph) const {
  std::vector<MotionPrior> priors;
  for (int to = 1; to < static_cast<int>(graph.nodes.size()); ++to) {
    const auto T_odom_from = findCameraPose(graph.nodes[static_cast<std::size_t>(to - 1)].stamp_ns);
    const auto T_odom_to = findCameraPose(graph.nodes[static_cast<std::size_t>(to)].stamp_ns);
    if (T_odom_from && T_odom_to) {
      priors.push_back({to - 1, to, T_odom_from->inverse() * *T_odom_to});
    }
  }
  return priors;
}

std::vector<char> OdometryPriors::carryLostFrames(const std::vector<TrackedFrame>& frames,
                                                  std::vector<Eigen::Isometry3d>& T_world_frame) const {
  std::vector<char> carried(frames.size(), 0);
  const bool was_ever_seen =
      std::any_of(frames.begin(), frames.end(), [](const TrackedFrame& frame) { return frame.status != TrackingStatus::kLost; });
  // Between bare walls there may be nothing to see from start to end; the world begins at the first frame all the same.
  std::optional<std::size_t> last = was_ever_seen || frames.empty() ? std::nullopt : std::optional<std::size_t>(0);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].status != TrackingStatus::kLost) {
      last = i;
      continue;
    }
    const auto T_odom_last = last ? findCameraPose(frames[*last].stamp_ns) : std::nullopt;
    const auto T_odom_now = findCameraPose(frames[i].stamp_ns);
    if (T_odom_last && T_odom_now) {
      T_world_frame[i] = T_world_frame[*last] * (T_odom_last->inverse() * *T_odom_now);
      carried[i] = 1;
    }
  }
  return carried;
}

}  // namespace oikos::mapping
