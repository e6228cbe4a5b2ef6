// SPDX-License-Identifier: Apache-2.0
// Differs from the paper in that the clique is found greedily and that drift is a constant per odometry edge: tracking's own
// covariances do not know of its systematic errors.
#include "mapping/graph/loop_consistency.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/error.h"

namespace oikos::mapping {

namespace {

/// Odometry edges make a forest: distances in edges between two nodes of one tree.
class OdometryForest {
 public:
  explicit OdometryForest(const KeyframeGraph& graph) : parent_(graph.nodes.size(), -1), depth_(graph.nodes.size(), 0) {
    for (const Edge& e : graph.edges) {
      if (e.kind == EdgeKind::kOdometry) {
        OIKOS_CHECK(e.from < e.to);  // a node is added after the one it hangs on
        parent_[static_cast<std::size_t>(e.to)] = e.from;
        depth_[static_cast<std::size_t>(e.to)] = depth_[static_cast<std::size_t>(e.from)] + 1;
      }
    }
  }

  [[nodiscard]] int distance(int a, int b) const {
    int steps = 0;
    while (a != b) {
      int& deeper = depth(a) >= depth(b) ? a : b;
      deeper = parent_[static_cast<std::size_t>(deeper)];
      OIKOS_CHECK(deeper >= 0);
      ++steps;
    }
    return steps;
  }

 private:
  [[nodiscard]] int depth(int node) const { return depth_[static_cast<std::size_t>(node)]; }
  std::vector<int> parent_;
  std::vector<int> depth_;
};

/// A loop's claim, from the sub-map with the lower number to the other, whichever way it was found.
struct Claim {
  int from;
  int to;
  Eigen::Isometry3d T_from_to;
};

class Judge {
 public:
  Judge(const KeyframeGraph& graph, const LoopConsistencyConfig& config) : graph_(graph), config_(config), forest_(graph) {}

  /// Does the way a.from → a.to → (odometry) → b.to → b.from → (odometry) → a.from come back to where it began?
  [[nodiscard]] bool consistent(const Claim& a, const Claim& b) const {
    const Eigen::Isometry3d round = a.T_from_to * between(a.to, b.to) * b.T_from_to.inverse() * between(b.from, a.from);
    return closes(round, forest_.distance(a.to, b.to) + forest_.distance(a.from, b.from), 2);
  }

  [[nodiscard]] bool agreesWithOdometry(const Edge& a) const {
    return submap(a.from) == submap(a.to) && closes(a.T_from_to * between(a.to, a.from), forest_.distance(a.from, a.to), 1);
  }

  [[nodiscard]] Claim claimOf(const Edge& e) const {
    return submap(e.from) <= submap(e.to) ? Claim{e.from, e.to, e.T_from_to} : Claim{e.to, e.from, e.T_from_to.inverse()};
  }

  [[nodiscard]] int submap(int node) const { return graph_.nodes[static_cast<std::size_t>(node)].submap; }

 private:
  [[nodiscard]] Eigen::Isometry3d between(int from, int to) const {
    return graph_.nodes[static_cast<std::size_t>(from)].T_world_camera.inverse() *
           graph_.nodes[static_cast<std::size_t>(to)].T_world_camera;
  }

  [[nodiscard]] bool closes(const Eigen::Isometry3d& round, int odometry_edges, int loops) const {
    const double turn_rad = Eigen::AngleAxisd(round.linear()).angle();
    const double sigma_rad = std::hypot(config_.drift_rad_per_edge * std::sqrt(odometry_edges), config_.loop_sigma_rad * std::sqrt(loops));
    // A turn on the way moves what lies beyond it: about half the way's edges, at a third of a metre each.
    const double lever_m = 0.15 * odometry_edges;
    const double sigma_m =
        std::hypot(config_.drift_m_per_edge * std::sqrt(odometry_edges), config_.loop_sigma_m * std::sqrt(loops), sigma_rad * lever_m);
    return turn_rad < config_.gate_sigmas * sigma_rad && round.translation().norm() < config_.gate_sigmas * sigma_m;
  }

  const KeyframeGraph& graph_;
  const LoopConsistencyConfig& config_;
  OdometryForest forest_;
};

/// Greedy clique from each edge in turn; the first of the largest.
std::vector<std::size_t> largestClique(const std::vector<std::vector<char>>& consistent) {
  const std::size_t n = consistent.size();
  std::vector<std::size_t> degree(n);
  for (std::size_t i = 0; i < n; ++i) {
    degree[i] = static_cast<std::size_t>(std::count(consistent[i].begin(), consistent[i].end(), 1));
  }
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return degree[a] > degree[b]; });
  std::vector<std::size_t> best;
  for (const std::size_t seed : order) {
    if (degree[seed] + 1 <= best.size()) {
      break;
    }
    std::vector<std::size_t> clique{seed};
    for (const std::size_t candidate : order) {
      const bool fits = candidate != seed &&
                        std::all_of(clique.begin(), clique.end(), [&](std::size_t member) { return consistent[candidate][member] != 0; });
      if (fits) {
        clique.push_back(candidate);
      }
    }
    if (clique.size() > best.size()) {
      best = std::move(clique);
    }
  }
  return best;
}

}  // namespace

std::vector<char> consistentEdges(const KeyframeGraph& graph, const LoopConsistencyConfig& config, int min_lone_inliers) {
  const Judge judge(graph, config);
  std::vector<char> believed(graph.edges.size(), 0);
  std::map<std::pair<int, int>, std::vector<std::size_t>> groups;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (edge.kind == EdgeKind::kOdometry) {
      believed[e] = 1;
    } else {
      groups[std::minmax({judge.submap(edge.from), judge.submap(edge.to)})].push_back(e);
    }
  }
  for (const auto& [submaps, edges] : groups) {
    std::vector<std::vector<char>> consistent(edges.size(), std::vector<char>(edges.size(), 0));
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t j = i + 1; j < edges.size(); ++j) {
        consistent[i][j] = consistent[j][i] =
            judge.consistent(judge.claimOf(graph.edges[edges[i]]), judge.claimOf(graph.edges[edges[j]])) ? 1 : 0;
      }
    }
    const std::vector<std::size_t> clique = largestClique(consistent);
    for (const std::size_t member : clique) {
      const Edge& edge = graph.edges[edges[member]];
      const bool lone_but_strong = submaps.first != submaps.second && edge.inliers >= min_lone_inliers;
      believed[edges[member]] = clique.size() > 1 || judge.agreesWithOdometry(edge) || lone_but_strong ? 1 : 0;
    }
  }
  return believed;
}

}  // namespace oikos::mapping
