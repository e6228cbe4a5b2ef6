// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/earlier_edges.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "core/geometry/se3.h"

namespace oikos::mapping {
namespace {

using geometry::Matrix6d;
using geometry::Vector6d;

Vector6d randomTwist(std::mt19937& random, double sigma) {
  std::normal_distribution<double> normal(0.0, sigma);
  Vector6d xi;
  for (int i = 0; i < 6; ++i) {
    xi[i] = normal(random);
  }
  return xi;
}

KeyframeGraph graphOf(int nodes) {
  std::mt19937 random(3);
  KeyframeGraph graph;
  for (int n = 0; n < nodes; ++n) {
    graph.nodes.emplace_back().T_world_camera = geometry::expSe3(randomTwist(random, 0.8));
  }
  return graph;
}

Matrix6d covarianceOf(std::mt19937& random) {
  Matrix6d covariance = 1e-4 * Matrix6d::Identity();
  for (int i = 0; i < 3; ++i) {
    const Vector6d xi = randomTwist(random, 0.01);
    covariance += xi * xi.transpose();
  }
  return covariance;
}

Eigen::Isometry3d between(const KeyframeGraph& graph, int from, int to) {
  return graph.nodes[static_cast<std::size_t>(from)].T_world_camera.inverse() * graph.nodes[static_cast<std::size_t>(to)].T_world_camera;
}

void addEdge(KeyframeGraph& graph, int from, int to, const Matrix6d& covariance) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.T_from_to = between(graph, from, to);
  edge.information = covariance.inverse();
  graph.edges.push_back(edge);
}

/// The first of the edges between these two.
const Edge& edgeBetween(const std::vector<Edge>& edges, int from, int to) {
  for (const Edge& edge : edges) {
    if (edge.from == from && edge.to == to) {
      return edge;
    }
  }
  static const Edge none;
  ADD_FAILURE() << "no edge from " << from << " to " << to;
  return none;
}

TEST(EarlierEdges, KeptNodesKeepTheirEdges) {
  std::mt19937 random(5);
  KeyframeGraph graph = graphOf(3);
  addEdge(graph, 0, 1, covarianceOf(random));
  addEdge(graph, 1, 2, covarianceOf(random));
  const std::vector<Edge> edges = edgesBetweenKept(graph, {0, 1, 2}, {1, 2, 3});
  ASSERT_EQ(edges.size(), 2U);
  for (std::size_t e = 0; e < 2; ++e) {
    EXPECT_LT((edges[e].information - graph.edges[e].information).norm(), 1e-6 * graph.edges[e].information.norm());
    EXPECT_LT(geometry::logSe3(edges[e].T_from_to.inverse() * graph.edges[e].T_from_to).norm(), 1e-12);
    EXPECT_EQ(edges[e].kind, EdgeKind::kOdometry);
  }
}

/// Perturbs both motions at random and looks at what the way over the left-out node does, for either direction of its edges.
TEST(EarlierEdges, TheWayOverALeftOutNodeHasTheSumOfItsErrors) {
  for (const bool backwards : {false, true}) {
    std::mt19937 random(11);
    KeyframeGraph graph = graphOf(3);
    const Matrix6d first = 1e-6 * covarianceOf(random) / 1e-4;
    const Matrix6d second = 1e-6 * covarianceOf(random) / 1e-4;
    const int a = backwards ? 2 : 0;
    const int b = backwards ? 0 : 2;
    addEdge(graph, a, 1, first);
    addEdge(graph, 1, b, second);
    const std::vector<Edge> edges = edgesBetweenKept(graph, {0, -1, 1}, {1, 2});
    ASSERT_EQ(edges.size(), 1U);
    const Eigen::LLT<Matrix6d> root_first(first);
    const Eigen::LLT<Matrix6d> root_second(second);
    Matrix6d sampled = Matrix6d::Zero();
    constexpr int kSamples = 40000;
    for (int s = 0; s < kSamples; ++s) {
      const Vector6d xi_first = root_first.matrixL() * randomTwist(random, 1.0);
      const Vector6d xi_second = root_second.matrixL() * randomTwist(random, 1.0);
      Eigen::Isometry3d way = between(graph, a, 1) * geometry::expSe3(xi_first) * between(graph, 1, b) * geometry::expSe3(xi_second);
      way = backwards ? way.inverse() : way;
      const Vector6d xi = geometry::logSe3(between(graph, 0, 2).inverse() * way);
      sampled += xi * xi.transpose() / kSamples;
    }
    const Matrix6d expected = edges[0].information.inverse();
    EXPECT_LT((sampled - expected).norm(), 0.05 * expected.norm()) << "backwards " << backwards;
  }
}

TEST(EarlierEdges, ParallelWaysAddTheirInformation) {
  std::mt19937 random(13);
  KeyframeGraph graph = graphOf(2);
  const Matrix6d covariance = covarianceOf(random);
  addEdge(graph, 0, 1, covariance);
  addEdge(graph, 0, 1, covariance);
  const std::vector<Edge> edges = edgesBetweenKept(graph, {0, 1}, {1, 2});
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_LT((edges[0].information - 2.0 * covariance.inverse()).norm(), 1e-6 * covariance.inverse().norm());
}

/// Loops that met in a bridge become ways between keyframes; what led to nodes that are not kept goes.
TEST(EarlierEdges, AStarOfLoopsStaysJoined) {
  std::mt19937 random(17);
  KeyframeGraph graph = graphOf(6);
  for (const int other : {0, 1, 2, 5}) {
    addEdge(graph, std::min(other, 3), std::max(other, 3), covarianceOf(random));
  }
  const std::vector<Edge> edges = edgesBetweenKept(graph, {0, 1, 2, -1, -1, -1}, {1, 2, 3});
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_TRUE(edgeBetween(edges, 0, 1).information.allFinite());
  EXPECT_TRUE(edgeBetween(edges, 0, 2).information.allFinite());
}

TEST(EarlierEdges, WhatIsNotJoinedIsHeldWeakly) {
  std::mt19937 random(19);
  KeyframeGraph graph = graphOf(4);
  addEdge(graph, 0, 1, 1e-3 * covarianceOf(random));  // as tracking measures it: better than a millimetre
  addEdge(graph, 2, 3, 1e-3 * covarianceOf(random));
  const std::vector<Edge> apart = edgesBetweenKept(graph, {0, 1, 2, 3}, {1, 2, 3, 4});
  ASSERT_EQ(apart.size(), 3U);
  const double weak = edgeBetween(apart, 1, 2).information.norm();
  EXPECT_LT(weak, 0.1 * edgeBetween(apart, 0, 1).information.norm());
  EXPECT_LT(geometry::logSe3(edgeBetween(apart, 1, 2).T_from_to.inverse() * between(graph, 1, 2)).norm(), 1e-12);
  EXPECT_EQ(edgesBetweenKept(graph, {0, 1, 2, 3}, {1, 1, 1, 1}).size(), 5U);  // of one drive: each is tied to the one before
}

}  // namespace
}  // namespace oikos::mapping
