// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/front_end.h"

#include <algorithm>
#include <map>
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
    lookAbout(current, seen);
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
