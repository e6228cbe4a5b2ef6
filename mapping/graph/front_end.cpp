// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/front_end.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "mapping/graph/front_end_frame.h"
#include "mapping/graph/local_map.h"
#include "mapping/odometry/rotation_alignment.h"

namespace oikos::mapping {

namespace {

/// Every n-th: neighbours in the list are of one keyframe, so all keyframes stay.
std::vector<Observation> evenlyThinned(const std::vector<Observation>& observations, std::size_t most) {
  std::vector<Observation> kept;
  kept.reserve(std::min(most, observations.size()));
  for (std::size_t i = 0; i < std::min(most, observations.size()); ++i) {
    kept.push_back(observations[i * observations.size() / std::min(most, observations.size())]);
  }
  return kept;
}

}  // namespace

FrontEnd::FrontEnd(const FrontEndTools& tools, const FrontEndConfig& config, const LoopConsistencyConfig& loops, std::uint64_t seed,
                   FrontEndResult map)
    : camera_(tools.camera),
      odometry_(tools.odometry),
      images_(tools.images),
      config_(config),
      loops_(loops),
      seed_(seed),
      result_(std::move(map)) {
  OIKOS_CHECK(result_.graph.settled == static_cast<int>(result_.graph.nodes.size()));
  for (int node = 0; node < result_.graph.settled; ++node) {
    places_.add(node, result_.features[static_cast<std::size_t>(node)]);
  }
  result_.submaps = result_.graph.settled > 0 ? 1 : 0;
}

void FrontEnd::add(const camera::RgbdFrame& frame) {
  Current current{frame, std::make_shared<const ImagePyramid>(frame.gray, config_.pyramid_levels), {}};
  if (reference_ < 0) {
    if (!startSubmap(current)) {
      record(current, {}, TrackingStatus::kLost);
    }
    return;
  }
  carryOn(current);
  FollowResult seen = follow(current, predict(current), active_);
  TrackingStatus status = TrackingStatus::kTracked;
  if (!seen.tracked || wheelsContradict(seen.pose.T_world_camera)) {
    status = TrackingStatus::kLost;
    if (auto recovered = recover(current)) {
      seen = std::move(*recovered);
      status = TrackingStatus::kRelocalised;
    }
  }
  if (status == TrackingStatus::kLost && ++lost_in_a_row_ > config_.max_lost_frames && startSubmap(current)) {
    return;
  }
  if (status != TrackingStatus::kLost) {
    lost_in_a_row_ = 0;
    wheels_ = WheelWay();
    T_previous_current_ = T_world_camera_.inverse() * seen.pose.T_world_camera;
    if (status == TrackingStatus::kRelocalised) {
      T_previous_current_.setIdentity();
    }
    T_world_camera_ = seen.pose.T_world_camera;
    reference_ = mainHost(result_.graph, seen.observations);
    if (keyframeDue(seen) && !borrowFromNeighbours(current, seen)) {
      addKeyframe(current, seen);
    }
  } else {
    T_world_camera_ = wheels_ ? T_world_camera_ * T_previous_current_ : T_world_camera_;
    T_previous_current_.setIdentity();
  }
  record(current, seen, status);
  previous_ = current.pyramid;
}

/// The wheels know better than the last motion how the camera has moved since the last frame.
void FrontEnd::carryOn(const Current& current) {
  const auto T_previous_current = odometry_.findMotion(result_.frames.back().stamp_ns, current.frame.stamp_ns);
  if (!T_previous_current) {
    wheels_.reset();
    return;
  }
  T_previous_current_ = *T_previous_current;
  if (wheels_) {
    wheels_->add(*T_previous_current);
  }
}

bool FrontEnd::wheelsContradict(const Eigen::Isometry3d& T_world_camera) const {
  const Eigen::Isometry3d T_world_expected = T_world_camera_ * T_previous_current_;
  return wheels_ && !config_.wheels.allows(T_world_expected.inverse() * T_world_camera, *wheels_);
}

/// A frame without enough to follow (a covered lens, the dark) is no place to begin at.
bool FrontEnd::startSubmap(const Current& current) {
  CornerDetectorConfig strong = config_.corners;
  strong.enough = 0;  // weak corners may be the dark's noise
  if (static_cast<int>(detectCorners(current.frame, {}, strong).size()) < config_.follower.min_inliers) {
    return false;
  }
  lost_in_a_row_ = 0;
  T_world_camera_ = wheels_ ? T_world_camera_ * T_previous_current_ : T_world_camera_;
  wheels_ = WheelWay();
  active_.clear();
  Current first = current;
  // Within a drive, recovery has just looked for known places in vain.
  const std::vector<Revisit> revisits = result_.graph.settled > 0 ? findRevisits(first) : std::vector<Revisit>();
  const int node = addNode(first, T_world_camera_);
  result_.graph.nodes.back().keyframe = true;
  latest_ = node;
  bridgeTo(node);
  ++result_.submaps;
  result_.graph.nodes.back().submap = result_.submaps - 1;
  host(current, node, {});
  reference_ = node;
  seen_at_keyframe_ = static_cast<int>(active_.size());
  T_previous_current_.setIdentity();
  result_.features.back() = first.getFeatures(camera_, config_.features);
  places_.add(node, result_.features.back());
  addLoops(node, revisits, seen_at_keyframe_);
  FollowResult seen;
  seen.pose.T_world_camera = T_world_camera_;
  record(current, seen, TrackingStatus::kStart);
  previous_ = current.pyramid;
  return true;
}

/// As far as the wheels know how the camera came here from the node before.
void FrontEnd::bridgeTo(int node) {
  const auto later = static_cast<std::size_t>(node);
  if (later > 0) {
    if (const auto T_before_now = odometry_.findMotion(result_.graph.nodes[later - 1].stamp_ns, result_.graph.nodes[later].stamp_ns)) {
      bridges_.push_back({node - 1, node, *T_before_now});
    }
  }
}

FrontEndResult FrontEnd::finish() {
  if (result_.graph.nodes.empty() && !result_.frames.empty()) {
    Node node;  // nothing was ever seen
    node.frame = result_.frames.front().frame;
    node.stamp_ns = result_.frames.front().stamp_ns;
    result_.graph.nodes.push_back(std::move(node));
    result_.features.emplace_back();
    result_.submaps = 1;
  }
  for (TrackedFrame& frame : result_.frames) {
    frame.reference = std::max(frame.reference, 0);  // lost before the first keyframe
  }
  return std::move(result_);
}

Eigen::Isometry3d FrontEnd::predict(const Current& current) const {
  const RotationAlignment turn = alignRotation(*previous_, *current.pyramid, camera_, T_previous_current_.linear());
  Eigen::Isometry3d T_previous_current = T_previous_current_;
  if (turn.converged) {
    T_previous_current.linear() = turn.R_previous_current;
  }
  return T_world_camera_ * T_previous_current;
}

FollowResult FrontEnd::follow(const Current& current, const Eigen::Isometry3d& T_world_camera, const std::vector<int>& landmarks) const {
  std::map<int, std::shared_ptr<const ImagePyramid>> hosts;
  std::vector<Candidate> candidates;
  candidates.reserve(landmarks.size());
  for (const int id : landmarks) {
    const Landmark& landmark = result_.graph.landmarks[static_cast<std::size_t>(id)];
    auto& pyramid = hosts[landmark.host];
    if (!pyramid) {
      pyramid = images_.get(result_.graph.nodes[static_cast<std::size_t>(landmark.host)].frame);
    }
    candidates.push_back({id, &landmark, result_.graph.nodes[static_cast<std::size_t>(landmark.host)].T_world_camera, pyramid.get()});
  }
  return followLandmarks({&camera_, current.pyramid.get(), &current.frame.depth_m}, candidates, T_world_camera, config_.follower);
}

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

void FrontEnd::record(const Current& current, const FollowResult& seen, TrackingStatus status) {
  TrackedFrame tracked;
  tracked.frame = current.frame.index;
  tracked.stamp_ns = current.frame.stamp_ns;
  tracked.status = status;
  tracked.reference = reference_;
  if (reference_ >= 0) {
    tracked.T_reference_frame = result_.graph.nodes[static_cast<std::size_t>(reference_)].T_world_camera.inverse() * T_world_camera_;
  }
  if (status != TrackingStatus::kLost) {
    tracked.observations = evenlyThinned(seen.observations, static_cast<std::size_t>(config_.kept_sightings));
    tracked.inliers = static_cast<int>(seen.observations.size());
    tracked.rms_px = seen.pose.rms_px;
  } else {
    ++result_.lost_frames;
  }
  result_.frames.push_back(std::move(tracked));
}

}  // namespace oikos::mapping
