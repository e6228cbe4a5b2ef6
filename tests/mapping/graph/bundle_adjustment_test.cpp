// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/mapping/graph/simulated_bundle.h"

namespace oikos::mapping {
namespace {

bool sameBits(const KeyframeGraph& a, const KeyframeGraph& b) {
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    if (std::memcmp(a.nodes[n].T_world_camera.data(), b.nodes[n].T_world_camera.data(), 16 * sizeof(double)) != 0) {
      return false;
    }
  }
  for (std::size_t l = 0; l < a.landmarks.size(); ++l) {
    if (std::memcmp(&a.landmarks[l].inverse_depth, &b.landmarks[l].inverse_depth, sizeof(double)) != 0) {
      return false;
    }
  }
  return true;
}

TEST(BundleAdjustment, ExactSightingsGiveTheTruth) {
  SimulatedBundle bundle({.pixel_sigma_px = 0.0, .depth_sigmas = 0.0});
  BundleAdjustmentConfig config;
  config.max_iterations = 50;
  ASSERT_GT(bundle.worstError_m(), 0.02);
  const BundleAdjustmentResult result = adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kFixed, config);
  EXPECT_TRUE(result.usable);
  EXPECT_GT(result.sightings, 1000);
  EXPECT_LT(bundle.worstError_m(), 1e-4);  // pixels and readings are kept as floats
  EXPECT_LT(bundle.worstTurn_rad(), 1e-4);
  EXPECT_LT(bundle.rmsDepthError_m(), 1e-4);
  EXPECT_LT(result.rms_px, 0.01);
  EXPECT_LT(result.final_cost, 1e-3 * result.initial_cost);
}

/// 0.3 px at 2 m and 525 px focal length is 1.1 mm of one sighting; each node has more than 100.
TEST(BundleAdjustment, NoiseIsAveraged) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SimulatedBundle bundle({.seed = seed});
    const double depth_before_m = bundle.rmsDepthError_m();
    const BundleAdjustmentResult result = adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kFixed, {});
    EXPECT_TRUE(result.usable);
    EXPECT_LT(bundle.worstError_m(), 0.002) << "seed " << seed;
    EXPECT_LT(bundle.worstTurn_rad(), 0.001) << "seed " << seed;
    EXPECT_LT(bundle.rmsDepthError_m(), 0.5 * depth_before_m) << "seed " << seed;
    EXPECT_NEAR(result.rms_px, 0.3 * std::sqrt(2.0), 0.06) << "seed " << seed;
  }
}

TEST(BundleAdjustment, OutliersAreTheKernelsBusiness) {
  SimulatedBundle bundle({.seed = 4});
  int spoiled = 0;
  for (Node& node : bundle.graph.nodes) {
    for (std::size_t i = 0; i < node.observations.size(); i += 10) {
      node.observations[i].pixel += Eigen::Vector2f(25.0F, -18.0F);
      ++spoiled;
    }
  }
  ASSERT_GT(spoiled, 100);
  ASSERT_TRUE(adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kFixed, {}).usable);
  EXPECT_LT(bundle.worstError_m(), 0.005);
  EXPECT_LT(bundle.worstTurn_rad(), 0.0025);
}

TEST(BundleAdjustment, FindsTheReadOutTime) {
  SimulatedBundle bundle({.seed = 5, .readout_s = 0.02});
  BundleAdjustmentConfig config;
  config.max_iterations = 50;
  const BundleAdjustmentResult result = adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kRefined, config);
  ASSERT_TRUE(result.usable);
  EXPECT_NEAR(result.readout_s, 0.02, 0.001);
  EXPECT_LT(bundle.worstError_m(), 0.003);
}

TEST(BundleAdjustment, FindsNoReadOutTimeWhereThereIsNone) {
  SimulatedBundle bundle({.seed = 6});
  const BundleAdjustmentResult result = adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kRefined, {});
  ASSERT_TRUE(result.usable);
  EXPECT_NEAR(result.readout_s, 0.0, 0.001);
}

TEST(BundleAdjustment, AFixedReadOutTimeStaysAndIsUsed) {
  SimulatedBundle right({.seed = 7, .readout_s = 0.02});
  SimulatedBundle ignored({.seed = 7, .readout_s = 0.02});
  const BundleAdjustmentResult with = adjustBundle(right.graph, right.camera, 0.02, Readout::kFixed, {});
  const BundleAdjustmentResult without = adjustBundle(ignored.graph, ignored.camera, 0.0, Readout::kFixed, {});
  EXPECT_EQ(with.readout_s, 0.02);
  EXPECT_EQ(without.readout_s, 0.0);
  EXPECT_LT(with.final_cost, 0.5 * without.final_cost);
  EXPECT_LT(right.worstError_m(), 0.003);
  EXPECT_LT(right.worstError_m(), ignored.worstError_m());
}

TEST(BundleAdjustment, WithoutSightingsNothingIsTouched) {
  SimulatedBundle bundle({.seed = 8});
  for (Node& node : bundle.graph.nodes) {
    node.observations.clear();
  }
  const KeyframeGraph before = bundle.graph;
  const BundleAdjustmentResult result = adjustBundle(bundle.graph, bundle.camera, 0.01, Readout::kRefined, {});
  EXPECT_FALSE(result.usable);
  EXPECT_EQ(result.sightings, 0);
  EXPECT_EQ(result.readout_s, 0.01);
  EXPECT_TRUE(sameBits(bundle.graph, before));
}

TEST(BundleAdjustment, AnEmptyGraphIsNotUsable) {
  KeyframeGraph graph;
  EXPECT_FALSE(adjustBundle(graph, {640, 480, 525.0, 525.0, 319.5, 239.5}, 0.0, Readout::kFixed, {}).usable);
}

TEST(BundleAdjustment, EachSubmapHasItsAnchor) {
  SimulatedBundle bundle({.seed = 9});
  for (std::size_t n = 0; n < bundle.graph.nodes.size(); ++n) {
    Node& node = bundle.graph.nodes[n];
    node.submap = n < 5 ? 0 : 1;
    std::erase_if(node.observations,
                  [&](const Observation& o) { return (bundle.graph.landmarks[static_cast<std::size_t>(o.landmark)].host < 5) != (n < 5); });
  }
  const KeyframeGraph before = bundle.graph;
  ASSERT_TRUE(adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kFixed, {}).usable);
  const auto shift_m = [&](std::size_t n) {
    return (bundle.graph.nodes[n].T_world_camera.translation() - before.nodes[n].T_world_camera.translation()).norm();
  };
  EXPECT_LT(shift_m(0), 1e-12);
  EXPECT_LT(shift_m(5), 1e-12);
  EXPECT_GT(shift_m(3), 1e-3);
  EXPECT_GT(shift_m(7), 1e-3);
}

TEST(BundleAdjustment, ASightingWithoutAReadingStillCounts) {
  SimulatedBundle bundle({.seed = 10});
  for (Node& node : bundle.graph.nodes) {
    for (Observation& o : node.observations) {
      o.depth_m = std::numeric_limits<Eigen::half>::quiet_NaN();
    }
  }
  ASSERT_TRUE(adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kFixed, {}).usable);
  EXPECT_LT(bundle.worstError_m(), 0.003);
}

TEST(BundleAdjustment, SameBitsTwice) {
  SimulatedBundle first({.seed = 11, .readout_s = 0.01});
  SimulatedBundle second({.seed = 11, .readout_s = 0.01});
  const BundleAdjustmentResult a = adjustBundle(first.graph, first.camera, 0.0, Readout::kRefined, {});
  const BundleAdjustmentResult b = adjustBundle(second.graph, second.camera, 0.0, Readout::kRefined, {});
  EXPECT_TRUE(sameBits(first.graph, second.graph));
  EXPECT_EQ(std::memcmp(&a.readout_s, &b.readout_s, sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(&a.final_cost, &b.final_cost, sizeof(double)), 0);
}

/// A node of an extended map that nothing is seen of stays where the map has it to its neighbours, whatever moves these.
TEST(BundleAdjustment, WhatIsSettledHoldsANodeWithoutSightings) {
  SimulatedBundle bundle({.pixel_sigma_px = 0.0, .depth_sigmas = 0.0});
  KeyframeGraph& graph = bundle.graph;
  const int alone = static_cast<int>(graph.nodes.size());
  Node node;
  node.T_world_camera = graph.nodes.back().T_world_camera * Eigen::Translation3d(0.1, 0.0, 0.0);
  Edge edge;
  edge.from = alone - 1;
  edge.to = alone;
  edge.T_from_to = graph.nodes.back().T_world_camera.inverse() * node.T_world_camera;
  graph.nodes.push_back(node);
  graph.edges.push_back(edge);
  graph.settled = alone + 1;
  const Eigen::Isometry3d before = graph.nodes[static_cast<std::size_t>(alone) - 1].T_world_camera;
  BundleAdjustmentConfig config;
  config.max_iterations = 50;
  ASSERT_TRUE(adjustBundle(graph, bundle.camera, 0.0, Readout::kFixed, config).usable);
  const Eigen::Isometry3d& neighbour = graph.nodes[static_cast<std::size_t>(alone) - 1].T_world_camera;
  ASSERT_GT((neighbour.translation() - before.translation()).norm(), 0.005);
  const Eigen::Isometry3d T_neighbour_alone = neighbour.inverse() * graph.nodes.back().T_world_camera;
  EXPECT_LT((T_neighbour_alone.translation() - Eigen::Vector3d(0.1, 0.0, 0.0)).norm(), 1e-3);
}

/// A map that is extended: all nodes are settled, each tied to the next one as the truth has it but for `edge_error_m` to all sides in
/// turn.
void settle(SimulatedBundle& bundle, double edge_error_m) {
  for (int n = 0; n + 1 < static_cast<int>(bundle.graph.nodes.size()); ++n) {
    Edge edge;
    edge.from = n;
    edge.to = n + 1;
    edge.T_from_to = bundle.T_world_true[static_cast<std::size_t>(n)].inverse() * bundle.T_world_true[static_cast<std::size_t>(n) + 1];
    edge.T_from_to.translation()[n % 3] += n % 2 == 0 ? edge_error_m : -edge_error_m;
    bundle.graph.edges.push_back(edge);
  }
  bundle.graph.settled = static_cast<int>(bundle.graph.nodes.size());
}

/// Three landmarks a node, seen with 3 px: 11 mm of one sighting at 2 m. Nine motions held to 1 mm and 1 mrad each make 3 mm and 3 mrad at
/// the end of the chain; three deviations are allowed. Held to 3 cm, the sightings bend it by more.
TEST(BundleAdjustment, FewAndPoorSightingsDoNotBendWhatIsSettled) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SimulatedBundle held({.seed = seed, .landmarks_per_node = 3, .pixel_sigma_px = 3.0, .start_shift_m = 0.0, .start_turn_rad = 0.0});
    settle(held, 0.0);
    SimulatedBundle loose = held;
    ASSERT_TRUE(adjustBundle(held.graph, held.camera, 0.0, Readout::kFixed, {}).usable);
    EXPECT_LT(held.worstError_m(), 0.009) << "seed " << seed;
    EXPECT_LT(held.worstTurn_rad(), 0.009) << "seed " << seed;
    BundleAdjustmentConfig config;
    config.settled_sigma_m = 0.03;
    config.settled_sigma_rad = 0.03;
    ASSERT_TRUE(adjustBundle(loose.graph, loose.camera, 0.0, Readout::kFixed, config).usable);
    EXPECT_GT(loose.worstError_m(), 0.009) << "seed " << seed;
  }
}

/// What many good sightings say to a millimetre and less puts right what is settled and 4 mm off.
TEST(BundleAdjustment, ManyGoodSightingsPutRightWhatIsSettled) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SimulatedBundle bundle({.seed = seed, .start_shift_m = 0.0, .start_turn_rad = 0.0});
    settle(bundle, 0.004);
    SimulatedBundle stiff = bundle;
    ASSERT_TRUE(adjustBundle(bundle.graph, bundle.camera, 0.0, Readout::kFixed, {}).usable);
    EXPECT_LT(bundle.worstError_m(), 0.003) << "seed " << seed;
    BundleAdjustmentConfig config;
    config.settled_sigma_m = 1e-5;
    config.settled_sigma_rad = 1e-5;
    ASSERT_TRUE(adjustBundle(stiff.graph, stiff.camera, 0.0, Readout::kFixed, config).usable);
    EXPECT_GT(stiff.worstError_m(), 0.004) << "seed " << seed;  // held so fast that nothing can
  }
}

}  // namespace
}  // namespace oikos::mapping
