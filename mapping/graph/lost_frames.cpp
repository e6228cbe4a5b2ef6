// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/lost_frames.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "mapping/odometry/rotation_alignment.h"

namespace oikos::mapping {

namespace {

bool isLost(const TrackedFrame& frame) {
  return frame.status == TrackingStatus::kLost;
}

class Retry {
 public:
  Retry(const KeyframeGraph& graph, const LostFrameTools& tools, std::vector<TrackedFrame>& frames,
        std::vector<Eigen::Isometry3d>& T_world_frame)
      : graph_(graph), tools_(tools), frames_(frames), T_world_frame_(T_world_frame) {}

  /// Follows landmarks from a neighbour that is not lost.
  bool from(std::size_t neighbour, std::size_t lost) {
    const camera::RgbdFrame frame = tools_.read(frames_[lost].frame);
    const ImagePyramid pyramid(frame.gray, tools_.pyramid_levels);
    const std::shared_ptr<const ImagePyramid> before = tools_.images.get(frames_[neighbour].frame);
    Eigen::Isometry3d T_world_predicted = T_world_frame_[neighbour];
    const RotationAlignment turn = alignRotation(*before, pyramid, tools_.camera, Eigen::Matrix3d::Identity());
    if (turn.converged) {
      T_world_predicted.linear() = T_world_predicted.linear() * turn.R_previous_current;
    }
    std::map<int, std::shared_ptr<const ImagePyramid>> hosts;
    const std::vector<Candidate> candidates = candidatesNear(T_world_predicted, frames_[neighbour].reference, hosts);
    FollowResult seen = followLandmarks({&tools_.camera, &pyramid, &frame.depth_m}, candidates, T_world_predicted, tools_.follower);
    if (!seen.tracked) {
      return false;
    }
    TrackedFrame& found = frames_[lost];
    found.status = TrackingStatus::kRelocalised;
    found.reference = frames_[neighbour].reference;
    found.T_reference_frame = graph_.nodes[static_cast<std::size_t>(found.reference)].T_world_camera.inverse() * seen.pose.T_world_camera;
    found.inliers = static_cast<int>(seen.observations.size());
    found.observations = std::move(seen.observations);
    found.rms_px = seen.pose.rms_px;
    T_world_frame_[lost] = seen.pose.T_world_camera;
    return true;
  }

 private:
  /// Landmarks of the nodes that look the same way from nearby.
  [[nodiscard]] std::vector<Candidate> candidatesNear(const Eigen::Isometry3d& T_world_camera, int reference,
                                                      std::map<int, std::shared_ptr<const ImagePyramid>>& hosts) const {
    constexpr std::size_t kNodes = 6;
    struct Near {
      double distance;
      int node;
    };
    std::vector<Near> nodes;
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
      const Node& node = graph_.nodes[n];
      if (node.submap != graph_.nodes[static_cast<std::size_t>(reference)].submap || node.hosted.empty()) {
        continue;
      }
      const Eigen::Isometry3d T_camera_node = T_world_camera.inverse() * node.T_world_camera;
      const double turn_rad = Eigen::AngleAxisd(T_camera_node.linear()).angle();
      nodes.push_back({T_camera_node.translation().norm() + turn_rad, static_cast<int>(n)});
    }
    std::stable_sort(nodes.begin(), nodes.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
    if (nodes.size() > kNodes) {
      nodes.resize(kNodes);
    }
    std::vector<Candidate> candidates;
    for (const Near& near : nodes) {
      const Node& node = graph_.nodes[static_cast<std::size_t>(near.node)];
      hosts[near.node] = tools_.images.get(node.frame);
      for (const int id : node.hosted) {
        candidates.push_back({id, &graph_.landmarks[static_cast<std::size_t>(id)], node.T_world_camera, hosts[near.node].get()});
      }
    }
    return candidates;
  }

  const KeyframeGraph& graph_;
  const LostFrameTools& tools_;
  std::vector<TrackedFrame>& frames_;
  std::vector<Eigen::Isometry3d>& T_world_frame_;
};

}  // namespace

int retryLostFrames(const KeyframeGraph& graph, const LostFrameTools& tools, std::vector<TrackedFrame>& frames,
                    std::vector<Eigen::Isometry3d>& T_world_frame) {
  Retry retry(graph, tools, frames, T_world_frame);
  int found = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (isLost(frames[i]) && !isLost(frames[i - 1])) {
      found += retry.from(i - 1, i) ? 1 : 0;
    }
  }
  for (std::size_t i = frames.size(); i-- > 1;) {
    if (isLost(frames[i - 1]) && !isLost(frames[i])) {
      found += retry.from(i, i - 1) ? 1 : 0;
    }
  }
  return found;
}

void bridgeLostFrames(const KeyframeGraph& graph, const std::vector<TrackedFrame>& frames, std::vector<Eigen::Isometry3d>& T_world_frame) {
  const auto submap = [&](std::size_t i) { return graph.nodes[static_cast<std::size_t>(frames[i].reference)].submap; };
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!isLost(frames[i])) {
      before = i;
      continue;
    }
    std::size_t after = i;
    while (after < frames.size() && isLost(frames[after])) {
      ++after;
    }
    if (before && after < frames.size() && submap(*before) == submap(after)) {
      const auto whole = static_cast<double>(frames[after].stamp_ns - frames[*before].stamp_ns);
      const auto part = static_cast<double>(frames[i].stamp_ns - frames[*before].stamp_ns);
      T_world_frame[i] = geometry::interpolate(T_world_frame[*before], T_world_frame[after], part / whole);
    } else if (before) {
      T_world_frame[i] = T_world_frame[*before];
    } else if (after < frames.size()) {
      T_world_frame[i] = T_world_frame[after];
    }
  }
}

}  // namespace oikos::mapping
