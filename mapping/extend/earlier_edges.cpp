// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/earlier_edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "core/geometry/se3.h"

namespace oikos::mapping {

namespace {

using geometry::Matrix6d;

/// Information between two nodes, of the right perturbation of the motion from the lower number to the higher.
using Links = std::map<std::pair<int, int>, Matrix6d>;

Eigen::Isometry3d between(const KeyframeGraph& graph, int from, int to) {
  return graph.nodes[static_cast<std::size_t>(from)].T_world_camera.inverse() * graph.nodes[static_cast<std::size_t>(to)].T_world_camera;
}

Matrix6d inverseOf(const Matrix6d& symmetric) {
  constexpr double kLeast = 1e-12;
  return (symmetric + kLeast * Matrix6d::Identity()).inverse();
}

/// Of the motion the other way: T^-1 is perturbed by -Ad(T) xi.
Matrix6d reversed(const Matrix6d& covariance, const Eigen::Isometry3d& T_from_to) {
  const Matrix6d A = geometry::adjoint(T_from_to);
  return A * covariance * A.transpose();
}

class Elimination {
 public:
  explicit Elimination(const KeyframeGraph& saved) : saved_(saved) {
    for (const Edge& edge : saved.edges) {
      if (edge.from != edge.to) {
        const Matrix6d covariance = inverseOf(edge.information);
        add(edge.from, edge.to, covariance);
      }
    }
  }

  /// Joins its neighbours: the first of them to each of the others.
  void remove(int node) {
    std::vector<std::pair<int, Matrix6d>> ways;  // from the node to each neighbour, with the covariance of that motion
    for (auto link = links_.begin(); link != links_.end();) {
      const auto [low, high] = link->first;
      if (low != node && high != node) {
        ++link;
        continue;
      }
      const Matrix6d covariance = inverseOf(link->second);
      ways.emplace_back(low == node ? high : low, low == node ? covariance : reversed(covariance, between(saved_, low, high)));
      link = links_.erase(link);
    }
    for (std::size_t i = 1; i < ways.size(); ++i) {
      const auto& [first, covariance_node_first] = ways.front();
      const auto& [other, covariance_node_other] = ways[i];
      const Matrix6d to_node = reversed(covariance_node_first, between(saved_, node, first));
      const Matrix6d A = geometry::adjoint(between(saved_, other, node));
      add(first, other, A * to_node * A.transpose() + covariance_node_other);
    }
  }

  [[nodiscard]] const Links& links() const { return links_; }

 private:
  void add(int from, int to, const Matrix6d& covariance) {
    const Matrix6d upwards = from < to ? covariance : reversed(covariance, between(saved_, from, to));
    const auto [link, is_new] = links_.try_emplace(std::minmax(from, to), Matrix6d::Zero());
    link->second += inverseOf(upwards);
  }

  const KeyframeGraph& saved_;
  Links links_;
};

/// Numbers of nodes, those that edges join with the same one.
class Parts {
 public:
  explicit Parts(std::size_t count) : part_(count) { std::iota(part_.begin(), part_.end(), 0); }
  [[nodiscard]] bool join(int a, int b) {
    const int from = part_[static_cast<std::size_t>(a)];
    const int into = part_[static_cast<std::size_t>(b)];
    std::replace(part_.begin(), part_.end(), from, into);
    return from != into;
  }

 private:
  std::vector<int> part_;
};

Edge makeEdge(int from, int to, const Eigen::Isometry3d& T_from_to, const Matrix6d& information) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.T_from_to = T_from_to;
  edge.information = information;
  return edge;
}

}  // namespace

std::vector<Edge> edgesBetweenKept(const KeyframeGraph& saved, const std::vector<int>& position, const std::vector<int>& drive) {
  Elimination elimination(saved);
  std::vector<int> kept;
  for (int node = 0; node < static_cast<int>(position.size()); ++node) {
    if (position[static_cast<std::size_t>(node)] < 0) {
      elimination.remove(node);
    } else {
      kept.push_back(node);
    }
  }
  std::vector<Edge> edges;
  Parts parts(kept.size());
  for (const auto& [ends, information] : elimination.links()) {
    const int from = position[static_cast<std::size_t>(ends.first)];
    const int to = position[static_cast<std::size_t>(ends.second)];
    edges.push_back(makeEdge(from, to, between(saved, ends.first, ends.second), information));
    (void)parts.join(from, to);
  }
  // As weak as a step of the wheels is to the pose graph, 3 cm and 0.03 rad, behind its PoseGraphConfig::information_scale.
  constexpr double kWeak = 3e4;
  for (int node = 1; node < static_cast<int>(kept.size()); ++node) {
    const auto n = static_cast<std::size_t>(node);
    const bool is_apart = parts.join(node - 1, node);
    if (is_apart || drive[n] == drive[n - 1]) {
      edges.push_back(makeEdge(node - 1, node, between(saved, kept[n - 1], kept[n]), kWeak * Matrix6d::Identity()));
    }
  }
  return edges;
}

}  // namespace oikos::mapping
