// SPDX-License-Identifier: Apache-2.0
// How the front end recognises places that it has seen before: after lost tracking, and to close loops.
#include <algorithm>
#include <utility>

#include "mapping/graph/front_end.h"
#include "mapping/graph/front_end_frame.h"
#include "mapping/graph/local_map.h"

namespace oikos::mapping {

/// By features: against the nodes about the last reference, then against all places.
std::optional<FollowResult> FrontEnd::recover(Current& current) {
  const Features& features = current.getFeatures(camera_, config_.features);
  std::vector<int> nodes = neighbourhood(result_.graph, reference_, 2);
  for (const PlaceIndex::Candidate& c : places_.query(features, config_.loop_candidates)) {
    if (std::find(nodes.begin(), nodes.end(), c.place) == nodes.end()) {
      nodes.push_back(c.place);
    }
  }
  std::erase_if(nodes, [&](int node) { return isInSettledWorld(node) && !isInSettledWorld(reference_); });  // one view is no proof
  for (const int node : nodes) {
    auto revisit = verify(current, {node, 0});
    if (revisit && wheelsContradict(revisit->seen.pose.T_world_camera)) {
      result_.loop_attempts.back().verdict = LoopCheck::kWheelsDisagree;
    } else if (revisit) {
      ++result_.relocalisations;
      adopt(revisit->seen);
      active_ = landmarksAbout(node, config_.neighbourhood, T_world_camera_);
      return std::move(revisit->seen);
    }
  }
  return std::nullopt;
}

std::optional<FrontEnd::Revisit> FrontEnd::verify(Current& current, const PlaceIndex::Candidate& candidate) {
  const auto old = static_cast<std::size_t>(candidate.place);
  const Features& features = current.getFeatures(camera_, config_.features);
  const std::vector<FeatureMatch> matches = matchFeatures(result_.features[old], features);
  const std::uint64_t seed = seed_ ^ (static_cast<std::uint64_t>(current.frame.index) << 32U) ^ static_cast<std::uint64_t>(candidate.place);
  const RelativeMotion motion = estimateMotion(result_.features[old], features, matches, camera_, config_.motion, seed);
  LoopAttempt attempt{candidate.place, current.frame.index,      candidate.votes, static_cast<int>(motion.inlier.size()),
                      motion.rms_px,   LoopCheck::kTooFewMatches};
  std::optional<Revisit> revisit;
  if (motion.status == MotionStatus::kConverged) {
    const Eigen::Isometry3d T_world_camera = result_.graph.nodes[old].T_world_camera * motion.T_a_b;
    FollowResult seen = follow(current, T_world_camera, landmarksAbout(candidate.place, 1, T_world_camera));
    attempt.verdict = LoopCheck::kGeometryDisagrees;
    if (seen.tracked) {
      attempt.verdict = LoopCheck::kAccepted;
      attempt.inliers = seen.pose.inliers;
      attempt.rms_px = seen.pose.rms_px;
      const std::vector<int>& own = result_.graph.nodes[old].hosted;
      const auto again = std::count_if(seen.observations.begin(), seen.observations.end(),
                                       [&](const Observation& o) { return std::binary_search(own.begin(), own.end(), o.landmark); });
      revisit =
          Revisit{candidate.place, std::move(seen), static_cast<double>(again) / std::max<double>(1.0, static_cast<double>(own.size()))};
    }
  } else if (motion.status != MotionStatus::kTooFewMatches) {
    attempt.verdict = LoopCheck::kGeometryDisagrees;
  }
  result_.loop_attempts.push_back(attempt);
  return revisit;
}

/// Places like the current view that are no neighbours, the likeliest first.
std::vector<FrontEnd::Revisit> FrontEnd::findRevisits(Current& current) {
  const Features& features = current.getFeatures(camera_, config_.features);
  const std::vector<int> near = neighbourhood(result_.graph, reference_, 2 * config_.neighbourhood);
  std::vector<Revisit> revisits;
  for (const PlaceIndex::Candidate& c : places_.query(features, config_.loop_candidates + static_cast<int>(near.size()))) {
    if (c.votes < config_.min_loop_votes || static_cast<int>(revisits.size()) >= config_.loop_candidates) {
      break;
    }
    if (!std::binary_search(near.begin(), near.end(), c.place)) {
      if (auto revisit = verify(current, c)) {
        revisits.push_back(std::move(*revisit));
      }
    }
  }
  return revisits;
}

/// An edge each; the one to go on from instead of a new keyframe, if there is one: it shows most of its old landmarks. `followed`:
/// landmarks that tracking followed into the node.
const FrontEnd::Revisit* FrontEnd::addLoops(int node, const std::vector<Revisit>& revisits, int followed) {
  const Revisit* best = nullptr;
  for (const Revisit& revisit : revisits) {
    addEdge(revisit.node, node, EdgeKind::kLoop, revisit.seen, revisit.seen.pose.T_world_camera);
    result_.graph.edges.back().observations = revisit.seen.observations;
    if ((best == nullptr || revisit.overlap > best->overlap) && mayGoOnFrom(revisit, result_.graph.edges.back(), followed)) {
      best = &revisit;
    }
  }
  return best;
}

/// Of the map that is extended, or of what goes on in its world.
bool FrontEnd::isInSettledWorld(int node) const {
  return result_.graph.settled > 0 && result_.graph.nodes[static_cast<std::size_t>(node)].submap == 0;
}

bool FrontEnd::mayGoOnFrom(const Revisit& revisit, const Edge& loop, int followed) const {
  if (isInSettledWorld(loop.from) && !isInSettledWorld(loop.to)) {
    return revisit.seen.pose.inliers >= config_.settled_share * followed && isConfirmed(result_.graph, loop, config_.settled_views, loops_);
  }
  return revisit.overlap >= config_.reuse_overlap && driftAllows(result_.graph, loop, bridges_, loops_);
}

/// Goes on in the world of other nodes: what was seen there becomes the present.
void FrontEnd::adopt(const FollowResult& seen) {
  T_world_camera_ = seen.pose.T_world_camera;
  reference_ = mainHost(result_.graph, seen.observations);
  seen_at_keyframe_ = std::max(seen.pose.inliers, 1);
}

}  // namespace oikos::mapping
