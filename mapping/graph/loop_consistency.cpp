// SPDX-License-Identifier: Apache-2.0
// Differs from the paper in that the clique is found greedily and that drift is a constant per odometry edge: tracking's own
// covariances do not know of its systematic errors.
#include "mapping/graph/loop_consistency.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "core/base/error.h"

namespace oikos::mapping {

namespace {

/// Odometry edges make a forest, and bridges join its trees: the way between two nodes of one tree, in edges.
class OdometryForest {
 public:
  OdometryForest(const KeyframeGraph& graph, const std::vector<MotionPrior>& bridges) : nodes_(graph.nodes.size()) {
    for (int settled = 1; settled < graph.settled; ++settled) {
      hang(settled, 0, kEdgesToASettled);
    }
    for (const Edge& e : graph.edges) {
      if (e.kind == EdgeKind::kOdometry && e.to >= graph.settled) {
        hang(e.to, e.from, 1);
      }
    }
    for (const MotionPrior& bridge : bridges) {
      hang(bridge.to, bridge.from, kEdgesOfABridge + static_cast<int>(bridge.T_from_to.translation().norm() * kEdgesPerBridged_m));
    }
  }

  [[nodiscard]] int distance(int a, int b) const {
    int way = 0;
    while (a != b) {
      int& later = a > b ? a : b;  // a node hangs on an earlier one
      const Hanging& node = nodes_[static_cast<std::size_t>(later)];
      OIKOS_CHECK(node.parent >= 0);
      way += node.edges;
      later = node.parent;
    }
    return way;
  }

 private:
  // Wheels are worth less than tracking: a bridge strays like so many edges.
  static constexpr int kEdgesOfABridge = 4;
  static constexpr int kEdgesPerBridged_m = 4;
  // An optimised map is off by no more between any two of its places, however long the way was between them.
  static constexpr int kEdgesToASettled = 4;
  struct Hanging {
    int parent = -1;
    int edges = 0;
  };
  void hang(int node, int on, int edges) {
    OIKOS_CHECK(on < node);
    nodes_[static_cast<std::size_t>(node)] = {on, edges};
  }
  std::vector<Hanging> nodes_;
};

/// The wheels' motion to the first node of each sub-map.
std::vector<MotionPrior> bridgesOf(const KeyframeGraph& graph, const std::vector<MotionPrior>& wheels) {
  std::vector<char> hangs(graph.nodes.size(), 0);
  for (const Edge& edge : graph.edges) {
    if (edge.kind == EdgeKind::kOdometry) {
      hangs[static_cast<std::size_t>(edge.to)] = 1;
    }
  }
  std::vector<MotionPrior> bridges;
  std::copy_if(wheels.begin(), wheels.end(), std::back_inserter(bridges),
               [&](const MotionPrior& wheel) { return hangs[static_cast<std::size_t>(wheel.to)] == 0; });
  return bridges;
}

/// The graph's nodes as far as their place goes, and the odometry between them; sub-maps are in one world where there is a bridge.
KeyframeGraph joinedBy(const std::vector<MotionPrior>& bridges, const KeyframeGraph& graph) {
  KeyframeGraph places;
  places.settled = graph.settled;
  for (const Node& node : graph.nodes) {
    Node& place = places.nodes.emplace_back();
    place.submap = node.submap;
    place.T_world_camera = node.T_world_camera;
  }
  for (const Edge& edge : graph.edges) {
    if (edge.kind == EdgeKind::kOdometry) {
      Edge& way = places.edges.emplace_back();
      way.from = edge.from;
      way.to = edge.to;
      way.kind = edge.kind;
    }
  }
  joinSubmaps(places, std::vector<char>(places.edges.size(), 0), bridges);
  return places;
}

/// A loop's claim, from the sub-map with the lower number to the other, whichever way it was found.
struct Claim {
  int from;
  int to;
  Eigen::Isometry3d T_from_to;
};

class Judge {
 public:
  Judge(const KeyframeGraph& graph, const LoopConsistencyConfig& config, const std::vector<MotionPrior>& bridges = {})
      : graph_(graph), config_(config), forest_(graph, bridges) {}

  /// Does the way a.from → a.to → (odometry) → b.to → b.from → (odometry) → a.from come back to where it began?
  [[nodiscard]] bool consistent(const Claim& a, const Claim& b) const {
    const Eigen::Isometry3d round = a.T_from_to * between(a.to, b.to) * b.T_from_to.inverse() * between(b.from, a.from);
    return sigmasOpen(round, forest_.distance(a.to, b.to) + forest_.distance(a.from, b.from), 2) < config_.gate_sigmas;
  }

  [[nodiscard]] bool agreesWithOdometry(const Edge& a) const {
    return submap(a.from) == submap(a.to) && strayedBy(a) < config_.gate_sigmas;
  }

  [[nodiscard]] bool leadsToLookAlike(const Edge& a) const {
    return submap(a.from) == submap(a.to) && strayedBy(a) > config_.look_alike_sigmas;
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

  [[nodiscard]] double strayedBy(const Edge& a) const {
    return sigmasOpen(a.T_from_to * between(a.to, a.from), forest_.distance(a.from, a.to), 1);
  }

  /// How far a way that should lead back to its beginning does not, in standard deviations.
  [[nodiscard]] double sigmasOpen(const Eigen::Isometry3d& round, int odometry_edges, int loops) const {
    const double turn_rad = Eigen::AngleAxisd(round.linear()).angle();
    const double sigma_rad = std::hypot(config_.drift_rad_per_edge * std::sqrt(odometry_edges), config_.loop_sigma_rad * std::sqrt(loops));
    // A turn on the way moves what lies beyond it: about half the way's edges, at a third of a metre each.
    const double lever_m = 0.15 * odometry_edges;
    const double sigma_m =
        std::hypot(config_.drift_m_per_edge * std::sqrt(odometry_edges), config_.loop_sigma_m * std::sqrt(loops), sigma_rad * lever_m);
    return std::max(turn_rad / sigma_rad, round.translation().norm() / sigma_m);
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

bool driftAllows(const KeyframeGraph& graph, const Edge& loop, const std::vector<MotionPrior>& wheels,
                 const LoopConsistencyConfig& config) {
  const std::vector<MotionPrior> bridges = bridgesOf(graph, wheels);
  const KeyframeGraph places = joinedBy(bridges, graph);
  const Judge judge(places, config, bridges);
  return judge.submap(loop.from) != judge.submap(loop.to) || judge.agreesWithOdometry(loop);
}

bool isConfirmed(const KeyframeGraph& graph, const Edge& loop, int views, const LoopConsistencyConfig& config) {
  const Judge judge(graph, config);
  const auto submaps = std::minmax({judge.submap(loop.from), judge.submap(loop.to)});
  std::set<int> seen_in{loop.to};
  for (const Edge& other : graph.edges) {
    const bool joins_the_same = other.kind == EdgeKind::kLoop && std::minmax({judge.submap(other.from), judge.submap(other.to)}) == submaps;
    if (joins_the_same && !seen_in.contains(other.to) && judge.consistent(judge.claimOf(loop), judge.claimOf(other))) {
      seen_in.insert(other.to);
    }
  }
  return static_cast<int>(seen_in.size()) >= views;
}

std::vector<char> consistentEdges(const KeyframeGraph& graph, const std::vector<MotionPrior>& wheels, const LoopConsistencyConfig& config,
                                  int min_lone_inliers) {
  const Judge judge(graph, config);
  const std::vector<MotionPrior> bridges = bridgesOf(graph, wheels);
  const KeyframeGraph places = joinedBy(bridges, graph);
  const Judge judge_of_places(places, config, bridges);
  std::vector<char> believed(graph.edges.size(), 0);
  std::map<std::pair<int, int>, std::vector<std::size_t>> groups;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (edge.kind == EdgeKind::kOdometry) {
      believed[e] = 1;
    } else if (!judge_of_places.leadsToLookAlike(edge)) {
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
      const bool is_into_settled = graph.settled > 0 && submaps.first == 0;
      const bool lone_but_strong = submaps.first != submaps.second && edge.inliers >= min_lone_inliers && !is_into_settled;
      believed[edges[member]] = clique.size() > 1 || judge.agreesWithOdometry(edge) || lone_but_strong ? 1 : 0;
    }
  }
  return believed;
}

}  // namespace oikos::mapping
