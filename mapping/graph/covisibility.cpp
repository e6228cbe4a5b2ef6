// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/covisibility.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>

#include "core/base/parallel.h"

namespace oikos::mapping {

namespace {

struct Partner {
  int node;
  int expected;  ///< landmarks that should be in view
};

class Matcher {
 public:
  Matcher(const KeyframeGraph& graph, const camera::PinholeCamera& camera, KeyframeImages& images, const FollowerConfig& follower,
          const CovisibilityConfig& config)
      : graph_(graph), camera_(camera), images_(images), follower_(follower), config_(config) {}

  [[nodiscard]] std::vector<Observation> match(int index) const {
    const Node& node = graph_.nodes[static_cast<std::size_t>(index)];
    std::set<int> known;
    for (const Observation& o : node.observations) {
      known.insert(o.landmark);
    }
    std::vector<Observation> found;
    const std::shared_ptr<const ImagePyramid> target = images_.get(node.frame);
    for (const Partner& partner : partners(index)) {
      const std::shared_ptr<const ImagePyramid> host = images_.get(graph_.nodes[static_cast<std::size_t>(partner.node)].frame);
      std::vector<Candidate> candidates;
      for (const int id : graph_.nodes[static_cast<std::size_t>(partner.node)].hosted) {
        if (!known.contains(id)) {
          candidates.push_back({id, &graph_.landmarks[static_cast<std::size_t>(id)],
                                graph_.nodes[static_cast<std::size_t>(partner.node)].T_world_camera, host.get()});
        }
      }
      for (const Observation& o :
           findLandmarks({&camera_, target.get(), nullptr}, candidates, node.T_world_camera, config_.gate_px, follower_)) {
        found.push_back(o);
      }
    }
    return found;
  }

 private:
  [[nodiscard]] std::vector<Partner> partners(int index) const {
    const Node& node = graph_.nodes[static_cast<std::size_t>(index)];
    const double min_cosine = std::cos(config_.max_view_deg * 3.14159265358979 / 180.0);
    std::vector<Partner> found;
    for (std::size_t other = 0; other < graph_.nodes.size(); ++other) {
      const Node& host = graph_.nodes[other];
      if (static_cast<int>(other) == index || host.submap != node.submap || host.hosted.empty() ||
          node.T_world_camera.linear().col(2).dot(host.T_world_camera.linear().col(2)) < min_cosine) {
        continue;
      }
      const int expected = countInView(graph_, static_cast<int>(other), node.T_world_camera, camera_);
      if (expected >= config_.min_expected) {
        found.push_back({static_cast<int>(other), expected});
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Partner& a, const Partner& b) { return a.expected > b.expected; });
    if (static_cast<int>(found.size()) > config_.max_partners) {
      found.resize(static_cast<std::size_t>(config_.max_partners));
    }
    return found;
  }

  const KeyframeGraph& graph_;
  const camera::PinholeCamera& camera_;
  KeyframeImages& images_;
  const FollowerConfig& follower_;
  const CovisibilityConfig& config_;
};

}  // namespace

int addCovisibleObservations(KeyframeGraph& graph, const camera::PinholeCamera& camera, KeyframeImages& images,
                             const FollowerConfig& follower, const CovisibilityConfig& config, int threads) {
  const Matcher matcher(graph, camera, images, follower, config);
  std::vector<std::vector<Observation>> found(graph.nodes.size());
  base::parallelFor(static_cast<int>(graph.nodes.size()), threads, [&](int n) { found[static_cast<std::size_t>(n)] = matcher.match(n); });
  int added = 0;
  for (std::size_t n = 0; n < found.size(); ++n) {
    auto& observations = graph.nodes[n].observations;
    observations.insert(observations.end(), found[n].begin(), found[n].end());
    added += static_cast<int>(found[n].size());
  }
  return added;
}

int thinSightings(KeyframeGraph& graph, int max_sightings) {
  std::vector<int> seen(graph.landmarks.size(), 0);
  for (const Node& node : graph.nodes) {
    for (const Observation& o : node.observations) {
      ++seen[static_cast<std::size_t>(o.landmark)];
    }
  }
  std::vector<int> passed(graph.landmarks.size(), 0);
  int removed = 0;
  for (Node& node : graph.nodes) {
    removed += static_cast<int>(std::erase_if(node.observations, [&](const Observation& o) {
      const auto l = static_cast<std::size_t>(o.landmark);
      const std::int64_t i = passed[l]++;
      return seen[l] > max_sightings && i * max_sightings / seen[l] == (i + 1) * max_sightings / seen[l];
    }));
  }
  return removed;
}

}  // namespace oikos::mapping
