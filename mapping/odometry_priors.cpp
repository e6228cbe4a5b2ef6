// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry_priors.h"

#include <algorithm>
#include <optional>

namespace oikos::mapping {

std::vector<MotionPrior> motionPriors(const WheelOdometry& odometry, const KeyframeGraph& graph) {
  std::vector<MotionPrior> priors;
  for (int to = 1; to < static_cast<int>(graph.nodes.size()); ++to) {
    const auto T_from_to =
        odometry.findMotion(graph.nodes[static_cast<std::size_t>(to - 1)].stamp_ns, graph.nodes[static_cast<std::size_t>(to)].stamp_ns);
    if (T_from_to) {
      priors.push_back({to - 1, to, *T_from_to});
    }
  }
  return priors;
}

std::vector<char> carryLostFrames(const WheelOdometry& odometry, const std::vector<TrackedFrame>& frames,
                                  std::vector<Eigen::Isometry3d>& T_world_frame) {
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
    const auto T_last_now = last ? odometry.findMotion(frames[*last].stamp_ns, frames[i].stamp_ns) : std::nullopt;
    if (T_last_now) {
      T_world_frame[i] = T_world_frame[*last] * *T_last_now;
      carried[i] = 1;
    }
  }
  return carried;
}

}  // namespace oikos::mapping
