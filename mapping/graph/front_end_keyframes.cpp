// SPDX-License-Identifier: Apache-2.0
// When the front end sets a keyframe, and when landmarks of others do instead.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "mapping/graph/front_end.h"
#include "mapping/graph/front_end_frame.h"
#include "mapping/graph/local_map.h"

namespace oikos::mapping {

bool FrontEnd::keyframeDue(const FollowResult& seen) const {
  return seen.pose.inliers < config_.keyframe_overlap * seen_at_keyframe_ || viewChange(seen) > 1.0;
}

/// From the nearest keyframe whose landmarks are seen, and the latest: 1 where a new one is due.
double FrontEnd::viewChange(const FollowResult& seen) const {
  std::set<int> hosts{latest_};
  double depth_sum = 0.0;
  for (const Observation& o : seen.observations) {
    const Landmark& landmark = result_.graph.landmarks[static_cast<std::size_t>(o.landmark)];
    hosts.insert(landmark.host);
    depth_sum += 1.0 / landmark.inverse_depth;
  }
  const double mean_depth_m = depth_sum / std::max<double>(1.0, static_cast<double>(seen.observations.size()));
  double least = std::numeric_limits<double>::infinity();
  for (const int host : hosts) {
    const Eigen::Isometry3d T_host_camera =
        result_.graph.nodes[static_cast<std::size_t>(host)].T_world_camera.inverse() * seen.pose.T_world_camera;
    const double turned_deg = Eigen::AngleAxisd(T_host_camera.linear()).angle() * 180.0 / 3.14159265358979;
    const double moved = T_host_camera.translation().norm() / mean_depth_m;
    least = std::min(least, std::max(turned_deg / config_.keyframe_rotation_deg, moved / config_.keyframe_parallax));
  }
  return least;
}

/// On ground that an earlier drive has settled no keyframe brings fresh landmarks: those of other keyframes that have come into view do.
void FrontEnd::lookAbout(const Current& current, FollowResult& seen) {
  if (reference_ >= result_.graph.settled || ++frames_since_look_ < config_.frames_a_look) {
    return;
  }
  frames_since_look_ = 0;
  std::vector<int> landmarks = landmarksAbout(reference_, config_.neighbourhood, seen.pose.T_world_camera);
  const int unknown = countUnknown(result_.graph, active_, landmarks, {camera_, seen.pose.T_world_camera});
  if (unknown < (config_.borrow_gain - 1.0) * seen.pose.inliers) {
    return;
  }
  FollowResult more = follow(current, seen.pose.T_world_camera, landmarks);
  if (more.tracked && more.pose.inliers >= seen.pose.inliers) {
    active_ = std::move(landmarks);
    seen = std::move(more);
    T_world_camera_ = seen.pose.T_world_camera;
    reference_ = mainHost(result_.graph, seen.observations);
  }
}

/// On known ground the landmarks of nearby keyframes may do instead of a new keyframe.
bool FrontEnd::borrowFromNeighbours(const Current& current, FollowResult& seen) {
  std::vector<int> landmarks = landmarksAbout(reference_, config_.neighbourhood, seen.pose.T_world_camera);
  if (seen.pose.inliers + countUnknown(result_.graph, active_, landmarks, {camera_, seen.pose.T_world_camera}) < seen_at_keyframe_) {
    return false;  // new ground: the neighbours cannot give what has gone out of view
  }
  FollowResult more = follow(current, seen.pose.T_world_camera, landmarks);
  if (!more.tracked || more.pose.inliers < config_.borrow_gain * seen_at_keyframe_) {
    return false;
  }
  active_ = std::move(landmarks);
  seen = std::move(more);
  T_world_camera_ = seen.pose.T_world_camera;
  reference_ = mainHost(result_.graph, seen.observations);
  return !keyframeDue(seen);
}

void FrontEnd::addKeyframe(Current& current, FollowResult& seen) {
  const Features& features = current.getFeatures(camera_, config_.features);
  const std::vector<Revisit> revisits = findRevisits(current);
  const int parent = reference_;
  const int node = addNode(current, seen.pose.T_world_camera);
  addEdge(parent, node, EdgeKind::kOdometry, seen, seen.pose.T_world_camera);
  Node& added = result_.graph.nodes[static_cast<std::size_t>(node)];
  added.submap = result_.graph.nodes[static_cast<std::size_t>(parent)].submap;
  added.observations = seen.observations;
  if (const Revisit* const reused = addLoops(node, revisits, seen.pose.inliers)) {
    ++result_.reused_keyframes;
    seen = reused->seen;
    adopt(seen);
    active_ = landmarksAbout(reused->node, config_.neighbourhood, T_world_camera_);
    seen_at_keyframe_ = seen.pose.inliers;
    return;
  }
  added.keyframe = true;
  latest_ = node;
  result_.features.back() = features;
  places_.add(node, features);
  host(current, node, seen.observations);
  reference_ = node;
  seen_at_keyframe_ = static_cast<int>(active_.size());
}

int FrontEnd::addNode(const Current& current, const Eigen::Isometry3d& T_world_camera) {
  Node node;
  node.frame = current.frame.index;
  node.stamp_ns = current.frame.stamp_ns;
  node.keyframe = false;
  node.T_world_camera = T_world_camera;
  result_.graph.nodes.push_back(std::move(node));
  result_.features.emplace_back();
  const int id = static_cast<int>(result_.graph.nodes.size()) - 1;
  images_.put(current.frame.index, current.pyramid);
  return id;
}

void FrontEnd::addEdge(int from, int to, EdgeKind kind, const FollowResult& seen, const Eigen::Isometry3d& T_world_to) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.kind = kind;
  edge.T_from_to = result_.graph.nodes[static_cast<std::size_t>(from)].T_world_camera.inverse() * T_world_to;
  edge.information = seen.pose.covariance.inverse();
  edge.inliers = seen.pose.inliers;
  edge.rms_px = seen.pose.rms_px;
  result_.graph.edges.push_back(edge);
}

/// New landmarks where none is seen; what was seen and what is new is looked for from now on.
void FrontEnd::host(const Current& current, int node, const std::vector<Observation>& seen) {
  std::vector<Eigen::Vector2d> occupied;
  active_.clear();
  for (const Observation& o : seen) {
    occupied.push_back(o.pixel.cast<double>());
    active_.push_back(o.landmark);
  }
  for (Landmark& landmark : detectCorners(current.frame, occupied, config_.corners)) {
    landmark.host = node;
    const int id = static_cast<int>(result_.graph.landmarks.size());
    result_.graph.landmarks.push_back(landmark);
    result_.graph.nodes[static_cast<std::size_t>(node)].hosted.push_back(id);
    active_.push_back(id);
  }
}

/// What the nodes up to `rings` edges away from this one lend to a camera there.
std::vector<int> FrontEnd::landmarksAbout(int node, int rings, const Eigen::Isometry3d& T_world_camera) const {
  const std::vector<int> nodes = neighbourhood(result_.graph, node, rings);
  return localMap(result_.graph, nodes, {camera_, T_world_camera}, config_.local_keyframes);
}

}  // namespace oikos::mapping
