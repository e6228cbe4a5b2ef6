// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/pairwise_front_end.h"

#include <algorithm>
#include <set>

#include "core/base/config_rules.h"

namespace oikos::mapping {

/// A motion found between a node and the present frame.
struct PairwiseFrontEnd::Link {
  int node = -1;
  RelativeMotion motion;  ///< a: the node, b: the frame
  double overlap = 0.0;   ///< inliers / matches
};

std::vector<std::string> PairwiseConfig::validate() const {
  return base::ConfigRules()
      .atLeast("predecessors", predecessors, 1)
      .atLeast("removed", removed, 0)
      .atLeast("drawn", drawn, 0)
      .atLeast("neighbourhood", neighbourhood, 1)
      .atLeast("loop_preference", loop_preference, 1.0)
      .between("keyframe_overlap", keyframe_overlap, 0.0, 1.0)
      .atLeast("max_lost_frames", max_lost_frames, 0)
      .messages();
}

PairwiseFrontEnd::PairwiseFrontEnd(const camera::PinholeCamera& camera, const PairwiseConfig& config, const FeatureConfig& features,
                                   const RelativeMotionConfig& motion, std::uint64_t seed)
    : camera_(camera), config_(config), feature_config_(features), motion_config_(motion), seed_(seed), random_(seed) {}

void PairwiseFrontEnd::add(const camera::RgbdFrame& frame) {
  Features features = extractFeatures(frame, camera_, feature_config_);
  if (result_.graph.nodes.empty()) {
    ++result_.submaps;
    addNode(frame, std::move(features), T_world_camera_, 0);
    record(frame, TrackingStatus::kStart, 0, nullptr);
    return;
  }
  const std::vector<Link> near = match(frame, features, predecessors());
  const bool follows_last = !near.empty() && near.front().node == static_cast<int>(result_.graph.nodes.size()) - 1;
  if (follows_last && near.front().overlap >= config_.keyframe_overlap) {
    lost_in_a_row_ = 0;
    record(frame, TrackingStatus::kTracked, near.front().node, &near.front());
    return;
  }
  std::vector<Link> loops = match(frame, features, drawLoopCandidates());
  const bool lost = near.empty() && loops.empty();
  if (lost && ++lost_in_a_row_ <= config_.max_lost_frames) {
    ++result_.lost_frames;
    record(frame, TrackingStatus::kLost, static_cast<int>(result_.graph.nodes.size()) - 1, nullptr);
    return;
  }
  lost_in_a_row_ = 0;
  if (lost) {
    addNode(frame, std::move(features), T_world_camera_, result_.submaps++);
    record(frame, TrackingStatus::kStart, static_cast<int>(result_.graph.nodes.size()) - 1, nullptr);
    return;
  }
  const TrackingStatus status = near.empty() ? TrackingStatus::kRelocalised : TrackingStatus::kTracked;
  result_.relocalisations += near.empty() ? 1 : 0;
  const Link parent = near.empty() ? loops.front() : near.front();
  const Node& parent_node = result_.graph.nodes[static_cast<std::size_t>(parent.node)];
  addNode(frame, std::move(features), parent_node.T_world_camera * parent.motion.T_a_b, parent_node.submap);
  addEdges(near.empty() ? std::vector<Link>{parent} : near, EdgeKind::kOdometry);
  if (near.empty()) {
    loops.erase(loops.begin());
  }
  addEdges(loops, EdgeKind::kLoop);
  record(frame, status, static_cast<int>(result_.graph.nodes.size()) - 1, nullptr);
}

/// The last p nodes, the latest first.
std::vector<int> PairwiseFrontEnd::predecessors() const {
  std::vector<int> nodes;
  const int count = static_cast<int>(result_.graph.nodes.size());
  for (int node = count - 1; node >= std::max(0, count - config_.predecessors); --node) {
    nodes.push_back(node);
  }
  return nodes;
}

std::vector<int> PairwiseFrontEnd::graphAbout(int node) const {
  std::set<int> found{node};
  for (int ring = 0; ring < config_.neighbourhood; ++ring) {
    std::set<int> wider = found;
    for (const Edge& e : result_.graph.edges) {
      if (found.contains(e.from)) {
        wider.insert(e.to);
      }
      if (found.contains(e.to)) {
        wider.insert(e.from);
      }
    }
    found = std::move(wider);
  }
  return {found.begin(), found.end()};
}

bool PairwiseFrontEnd::nextToLoop(int node) const {
  return std::any_of(result_.graph.edges.begin(), result_.graph.edges.end(), [&](const Edge& e) {
    return e.kind == EdgeKind::kLoop && (std::abs(e.from - node) <= 1 || std::abs(e.to - node) <= 1);
  });
}

/// n different nodes; the k-th earliest of m is drawn with a weight of m - k.
std::vector<int> PairwiseFrontEnd::drawLoopCandidates() {
  const int last = static_cast<int>(result_.graph.nodes.size()) - 1;
  const int matched_already = std::max(config_.removed, config_.predecessors);
  std::vector<int> pool = graphAbout(last);
  std::erase_if(pool, [&](int node) { return node > last - matched_already; });
  std::vector<int> chosen;
  while (!pool.empty() && static_cast<int>(chosen.size()) < config_.drawn) {
    std::vector<double> weight;
    double total = 0.0;
    for (std::size_t k = 0; k < pool.size(); ++k) {
      weight.push_back(static_cast<double>(pool.size() - k) * (nextToLoop(pool[k]) ? config_.loop_preference : 1.0));
      total += weight.back();
    }
    double left = total * static_cast<double>(random_() >> 11U) * 0x1p-53;
    std::size_t k = 0;
    while (k + 1 < pool.size() && left >= weight[k]) {
      left -= weight[k++];
    }
    chosen.push_back(pool[k]);
    pool.erase(pool.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return chosen;
}

std::vector<PairwiseFrontEnd::Link> PairwiseFrontEnd::match(const camera::RgbdFrame& frame, const Features& features,
                                                            const std::vector<int>& nodes) {
  std::vector<Link> links;
  for (const int node : nodes) {
    const Features& old = result_.features[static_cast<std::size_t>(node)];
    const std::vector<FeatureMatch> matches = matchFeatures(old, features);
    const std::uint64_t seed = seed_ ^ (static_cast<std::uint64_t>(frame.index) << 32U) ^ static_cast<std::uint64_t>(node);
    RelativeMotion motion = estimateMotion(old, features, matches, camera_, motion_config_, seed);
    if (motion.status == MotionStatus::kConverged) {
      const double overlap = static_cast<double>(motion.inlier.size()) /
                             static_cast<double>(std::max<std::size_t>(1, std::min(old.pixel.size(), features.pixel.size())));
      links.push_back({node, std::move(motion), overlap});
    }
  }
  return links;
}

void PairwiseFrontEnd::addNode(const camera::RgbdFrame& frame, Features features, const Eigen::Isometry3d& T_world_camera, int submap) {
  Node node;
  node.frame = frame.index;
  node.stamp_ns = frame.stamp_ns;
  node.submap = submap;
  node.T_world_camera = T_world_camera;
  result_.graph.nodes.push_back(std::move(node));
  result_.features.push_back(std::move(features));
}

void PairwiseFrontEnd::addEdges(const std::vector<Link>& links, EdgeKind kind) {
  const int to = static_cast<int>(result_.graph.nodes.size()) - 1;
  for (const Link& link : links) {
    Edge edge;
    edge.from = link.node;
    edge.to = to;
    edge.kind = kind;
    edge.T_from_to = link.motion.T_a_b;
    edge.information = link.motion.covariance.inverse();
    edge.inliers = static_cast<int>(link.motion.inlier.size());
    edge.rms_px = link.motion.rms_px;
    result_.graph.edges.push_back(std::move(edge));
  }
}

void PairwiseFrontEnd::record(const camera::RgbdFrame& frame, TrackingStatus status, int reference, const Link* link) {
  TrackedFrame tracked;
  tracked.frame = frame.index;
  tracked.stamp_ns = frame.stamp_ns;
  tracked.status = status;
  tracked.reference = reference;
  const Eigen::Isometry3d& T_world_reference = result_.graph.nodes[static_cast<std::size_t>(reference)].T_world_camera;
  if (link != nullptr) {
    tracked.T_reference_frame = link->motion.T_a_b;
    tracked.inliers = static_cast<int>(link->motion.inlier.size());
    tracked.rms_px = link->motion.rms_px;
  } else if (status == TrackingStatus::kLost) {
    tracked.T_reference_frame = T_world_reference.inverse() * T_world_camera_;
  }
  T_world_camera_ = T_world_reference * tracked.T_reference_frame;
  result_.frames.push_back(std::move(tracked));
}

}  // namespace oikos::mapping
