// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/covisibility.h"

#include <gtest/gtest.h>

#include <vector>

namespace oikos::mapping {
namespace {

/// Landmark 0 is seen from every node, landmark 1 from the first three.
KeyframeGraph seenFrom(int nodes) {
  KeyframeGraph graph;
  graph.landmarks.resize(2);
  graph.nodes.resize(static_cast<std::size_t>(nodes));
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    for (int landmark = 0; landmark < (n < 3 ? 2 : 1); ++landmark) {
      Observation seen;
      seen.landmark = landmark;
      graph.nodes[n].observations.push_back(seen);
    }
  }
  return graph;
}

std::vector<int> nodesThatSee(const KeyframeGraph& graph, int landmark) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    for (const Observation& o : graph.nodes[n].observations) {
      if (o.landmark == landmark) {
        nodes.push_back(static_cast<int>(n));
      }
    }
  }
  return nodes;
}

TEST(ThinSightings, KeepsSoManyEvenlyOverTheDrive) {
  KeyframeGraph graph = seenFrom(40);
  EXPECT_EQ(thinSightings(graph, 10), 30);
  const std::vector<int> kept = nodesThatSee(graph, 0);
  ASSERT_EQ(kept.size(), 10U);
  for (std::size_t i = 1; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i] - kept[i - 1], 4);
  }
  EXPECT_EQ(nodesThatSee(graph, 1), (std::vector<int>{0, 1, 2}));
}

TEST(ThinSightings, LeavesAsManyAsAllowedAlone) {
  KeyframeGraph graph = seenFrom(10);
  EXPECT_EQ(thinSightings(graph, 10), 0);
  EXPECT_EQ(nodesThatSee(graph, 0).size(), 10U);
  EXPECT_EQ(thinSightings(graph, 7), 3);
  EXPECT_EQ(nodesThatSee(graph, 0).size(), 7U);
}

}  // namespace
}  // namespace oikos::mapping
