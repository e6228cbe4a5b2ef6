// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/pose_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "mapping/graph/loop_consistency.h"
#include "tests/mapping/graph/simulated_drive.h"

namespace oikos::mapping {
namespace {

constexpr int kLap = SimulatedDrive::kNodesPerLap;

/// Half the square is 15 edges from the nearest fixed place; what they stray by at 5 mm and 3 mrad an edge, with a lever of up to 3 m,
/// stays under this with loops all along the way.
constexpr double kClosedError_m = 0.08;

/// What Cauchy's kernel leaves of a loop between places a metre apart: at 5 cm a sigma (an information of 0.04 / (1 cm)^2) it is off by 20
/// sigmas, 1 / (1 + (20 / 3)^2).
constexpr double kWeightOfWrong = 0.022;

std::vector<std::size_t> closeLaps(SimulatedDrive& drive, int step) {
  std::vector<std::size_t> edges;
  for (int n = 0; n < kLap; n += step) {
    edges.push_back(drive.addLoop(n, n + kLap));
  }
  return edges;
}

/// Loops of the first lap's end with its beginning, which bind the square itself.
void closeSquare(SimulatedDrive& drive) {
  for (const int n : {kLap - 1, kLap, kLap + 1}) {
    drive.addLoop(0, n);
  }
}

double worstWeight(const PoseGraphResult& result, const std::vector<std::size_t>& edges) {
  double worst = 0.0;
  for (const std::size_t e : edges) {
    worst = std::max(worst, result.loop_weight[e]);
  }
  return worst;
}

double leastWeight(const PoseGraphResult& result, const std::vector<std::size_t>& edges) {
  double least = 1.0;
  for (const std::size_t e : edges) {
    least = std::min(least, result.loop_weight[e]);
  }
  return least;
}

PoseGraphConfig withoutKernel() {
  PoseGraphConfig config;
  config.cauchy_sigmas = 1e9;
  return config;
}

TEST(PoseGraph, ExactMeasurementsGiveTheTruth) {
  SimulatedDrive drive(1);
  for (Edge& edge : drive.graph.edges) {
    edge.T_from_to = drive.trueMotion(edge.from, edge.to);
  }
  drive.addWrongLoop(0, kLap, drive.trueMotion(0, kLap));
  drive.addWrongLoop(20, kLap + 20, drive.trueMotion(20, kLap + 20));
  ASSERT_GT(drive.worstError_m(), 0.05);
  const PoseGraphResult result = optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {});
  EXPECT_TRUE(result.usable);
  EXPECT_LT(drive.worstError_m(), 1e-5);
  EXPECT_LT(drive.worstTurn_rad(), 1e-5);
  EXPECT_LT(result.final_cost, 1e-6);
  EXPECT_GT(result.initial_cost, result.final_cost);
}

TEST(PoseGraph, LoopsTakeTheDriftAway) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SimulatedDrive drive(seed);
    closeSquare(drive);
    const auto loops = closeLaps(drive, 4);
    const double before_m = drive.worstError_m();
    const PoseGraphResult result = optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {});
    ASSERT_TRUE(result.usable);
    EXPECT_LT(drive.worstError_m(), kClosedError_m) << "seed " << seed;
    EXPECT_LT(drive.worstError_m(), before_m) << "seed " << seed;
    EXPECT_GT(leastWeight(result, loops), 0.5) << "seed " << seed;
  }
}

TEST(PoseGraph, TheFirstNodeStays) {
  SimulatedDrive drive(2);
  closeLaps(drive, 4);
  const Eigen::Matrix4d before = drive.graph.nodes[0].T_world_camera.matrix();
  ASSERT_TRUE(optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {}).usable);
  EXPECT_LT((drive.graph.nodes[0].T_world_camera.matrix() - before).norm(), 1e-12);
}

TEST(PoseGraph, WrongLoopsAreRejectedBeforeAndTheTrajectoryIsAsWithoutThem) {
  SimulatedDrive drive(3);
  closeSquare(drive);
  closeLaps(drive, 2);
  SimulatedDrive misled = drive;
  const auto wrong = misled.addRandomWrongLoops(10);
  const auto believed = consistentEdges(misled.graph, {}, {});
  ASSERT_TRUE(optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {}).usable);
  const PoseGraphResult result = optimisePoseGraph(misled.graph, believed, {}, {});
  ASSERT_TRUE(result.usable);
  EXPECT_DOUBLE_EQ(misled.worstError_m(), drive.worstError_m());
  EXPECT_EQ(worstWeight(result, wrong), 0.0);
}

/// The second line of defence: all loops are believed, three in ten are wrong, and only the kernel can tell.
TEST(PoseGraph, TheKernelHoldsOutAgainstWrongLoops) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SimulatedDrive drive(seed);
    closeSquare(drive);
    const auto loops = closeLaps(drive, 2);
    const auto wrong = drive.addRandomWrongLoops(9);
    SimulatedDrive naive = drive;
    const PoseGraphResult result = optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {});
    ASSERT_TRUE(result.usable);
    EXPECT_LT(drive.worstError_m(), kClosedError_m) << "seed " << seed;
    EXPECT_LT(worstWeight(result, wrong), kWeightOfWrong) << "seed " << seed;
    EXPECT_GT(leastWeight(result, loops), 0.5) << "seed " << seed;
    ASSERT_TRUE(optimisePoseGraph(naive.graph, naive.allBelieved(), {}, withoutKernel()).usable);
    EXPECT_GT(naive.worstError_m(), 5.0 * kClosedError_m) << "seed " << seed;  // what would be without it
  }
}

TEST(PoseGraph, TheKernelHoldsOutAgainstATwinPlace) {
  SimulatedDrive drive(4);
  closeSquare(drive);
  closeLaps(drive, 2);
  std::vector<std::size_t> wrong;
  for (int n = 2; n < 8; ++n) {
    wrong.push_back(drive.addWrongLoop(n, n + 10, Eigen::Isometry3d::Identity()));
  }
  SimulatedDrive naive = drive;
  const PoseGraphResult result = optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {});
  ASSERT_TRUE(result.usable);
  EXPECT_LT(drive.worstError_m(), kClosedError_m);
  EXPECT_LT(worstWeight(result, wrong), kWeightOfWrong);
  ASSERT_TRUE(optimisePoseGraph(naive.graph, naive.allBelieved(), {}, withoutKernel()).usable);
  EXPECT_GT(naive.worstError_m(), 5.0 * kClosedError_m);
}

TEST(PoseGraph, WithoutMeasurementsNothingIsUsableAndNothingMoves) {
  SimulatedDrive drive(5);
  KeyframeGraph graph = drive.graph;
  graph.edges.clear();
  const PoseGraphResult result = optimisePoseGraph(graph, {}, {}, {});
  EXPECT_FALSE(result.usable);
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    EXPECT_EQ(graph.nodes[n].T_world_camera.matrix(), drive.graph.nodes[n].T_world_camera.matrix());
  }
}

TEST(PoseGraph, AnInformationWithoutRankLeavesThePosesFinite) {
  SimulatedDrive drive(6);
  closeLaps(drive, 4);
  for (Edge& edge : drive.graph.edges) {
    edge.information.setZero();
  }
  EXPECT_TRUE(optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {}).usable);
  for (const Node& node : drive.graph.nodes) {
    EXPECT_TRUE(node.T_world_camera.matrix().allFinite());
  }
}

TEST(PoseGraph, SameBitsTwice) {
  SimulatedDrive first(7);
  closeLaps(first, 3);
  first.addRandomWrongLoops(3);
  SimulatedDrive second = first;
  ASSERT_TRUE(optimisePoseGraph(first.graph, first.allBelieved(), {}, {}).usable);
  ASSERT_TRUE(optimisePoseGraph(second.graph, second.allBelieved(), {}, {}).usable);
  for (std::size_t n = 0; n < first.graph.nodes.size(); ++n) {
    EXPECT_EQ(std::memcmp(first.graph.nodes[n].T_world_camera.data(), second.graph.nodes[n].T_world_camera.data(), 16 * sizeof(double)), 0);
  }
}

/// A wheel odometry that slips once by a metre does not bend the drive; one that does not slip carries a stretch without images.
TEST(PoseGraph, AMotionPriorIsWeakAndRobust) {
  SimulatedDrive drive(8);
  closeSquare(drive);
  closeLaps(drive, 2);
  std::vector<MotionPrior> priors;
  for (int n = 1; n < 2 * kLap; ++n) {
    priors.push_back({n - 1, n, drive.trueMotion(n - 1, n)});
  }
  priors[25].T_from_to.translation() += Eigen::Vector3d(0.0, 0.0, 1.0);
  ASSERT_TRUE(optimisePoseGraph(drive.graph, drive.allBelieved(), priors, {}).usable);
  EXPECT_LT(drive.worstError_m(), kClosedError_m);
}

/// A step of a centimetre and one of ten metres, each against one more measurement that is off by 10 cm: the wheels' drift is known.
TEST(PoseGraph, ALongStepOfTheWheelsIsTrustedLess) {
  const auto pulled = [](double way_m) {
    KeyframeGraph graph;
    graph.nodes.resize(2);
    graph.nodes[1].T_world_camera.translation().x() = way_m;
    Edge edge;
    edge.from = 0;
    edge.to = 1;
    edge.T_from_to.translation().x() = way_m + 0.1;
    edge.information *= 1.0 / (0.04 * 0.1 * 0.1);  // 10 cm, behind information_scale
    graph.edges.push_back(edge);
    MotionPrior wheels{0, 1, Eigen::Isometry3d(Eigen::Translation3d(way_m, 0.0, 0.0))};
    EXPECT_TRUE(optimisePoseGraph(graph, {1}, {wheels}, {}).usable);
    return graph.nodes[1].T_world_camera.translation().x() - way_m;
  };
  EXPECT_LT(pulled(0.01), 0.02);  // 3 cm against 10 cm
  EXPECT_GT(pulled(10.0), 0.08);  // 30 cm against 10 cm
}

TEST(JoinSubmaps, ALoopBringsTwoWorldsTogether) {
  SimulatedDrive drive(10);
  const double drift_m = drive.worstError_m();
  const Eigen::Isometry3d T_own_world = Eigen::Translation3d(4.0, -2.0, 0.5) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitX());
  drive.breakAt(kLap, T_own_world);
  ASSERT_GT(drive.worstError_m(), 1.0);
  const std::size_t loop = drive.addLoop(3, kLap + 3);
  EXPECT_EQ(joinSubmaps(drive.graph, drive.allBelieved(), {}), 1);
  EXPECT_LT(drive.worstError_m(), drift_m + 0.2);
  const Eigen::Isometry3d T_from_to = drive.graph.nodes[3].T_world_camera.inverse() * drive.graph.nodes[kLap + 3].T_world_camera;
  EXPECT_LT((T_from_to.matrix() - drive.graph.edges[loop].T_from_to.matrix()).norm(), 1e-9);
  EXPECT_TRUE(std::all_of(drive.graph.nodes.begin(), drive.graph.nodes.end(), [](const Node& n) { return n.submap == 0; }));
}

TEST(JoinSubmaps, TheLowerNumberKeepsItsWorldWhicheverWayTheLoopPoints) {
  SimulatedDrive drive(11);
  drive.breakAt(kLap, Eigen::Isometry3d(Eigen::Translation3d(0.0, 9.0, 0.0)));
  drive.addLoop(kLap + 5, 5);
  const Eigen::Matrix4d before = drive.graph.nodes[2].T_world_camera.matrix();
  EXPECT_EQ(joinSubmaps(drive.graph, drive.allBelieved(), {}), 1);
  EXPECT_EQ(drive.graph.nodes[2].T_world_camera.matrix(), before);
  EXPECT_LT(drive.worstError_m(), 1.0);
}

TEST(JoinSubmaps, AMotionPriorJoinsWhereNoLoopDoes) {
  SimulatedDrive drive(12);
  drive.breakAt(kLap, Eigen::Isometry3d(Eigen::Translation3d(0.0, 9.0, 0.0)));
  const std::vector<MotionPrior> priors = {{kLap - 1, kLap, drive.trueMotion(kLap - 1, kLap)}};
  EXPECT_EQ(joinSubmaps(drive.graph, drive.allBelieved(), priors), 1);
  EXPECT_LT(drive.worstError_m(), 1.0);
}

TEST(JoinSubmaps, ALoopIsPreferredToAMotionPrior) {
  SimulatedDrive drive(13);
  drive.breakAt(kLap, Eigen::Isometry3d(Eigen::Translation3d(0.0, 9.0, 0.0)));
  drive.addLoop(5, kLap + 5);
  const std::vector<MotionPrior> slipped = {{kLap - 1, kLap, Eigen::Isometry3d(Eigen::Translation3d(3.0, 0.0, 0.0))}};
  EXPECT_EQ(joinSubmaps(drive.graph, drive.allBelieved(), slipped), 1);
  EXPECT_LT(drive.worstError_m(), 1.0);
}

TEST(JoinSubmaps, ADoubtedLoopJoinsNothing) {
  SimulatedDrive drive(14);
  drive.breakAt(kLap, Eigen::Isometry3d(Eigen::Translation3d(0.0, 9.0, 0.0)));
  const std::size_t loop = drive.addLoop(5, kLap + 5);
  std::vector<char> believed = drive.allBelieved();
  believed[loop] = 0;
  const KeyframeGraph before = drive.graph;
  EXPECT_EQ(joinSubmaps(drive.graph, believed, {}), 2);
  for (std::size_t n = 0; n < before.nodes.size(); ++n) {
    EXPECT_EQ(drive.graph.nodes[n].submap, before.nodes[n].submap);
    EXPECT_EQ(drive.graph.nodes[n].T_world_camera.matrix(), before.nodes[n].T_world_camera.matrix());
  }
}

TEST(JoinSubmaps, ChainsOfSubmapsAreJoinedInAnyOrder) {
  SimulatedDrive drive(15);
  drive.breakAt(30, Eigen::Isometry3d(Eigen::Translation3d(0.0, 9.0, 0.0)));
  drive.breakAt(60, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 5.0)));
  drive.addLoop(35, 75);  // the third with the second
  drive.addLoop(5, 45);   // the second with the first
  EXPECT_EQ(joinSubmaps(drive.graph, drive.allBelieved(), {}), 1);
  EXPECT_LT(drive.worstError_m(), 1.0);
}

/// Each part that stays apart has its own fixed node, or the solver would have a free gauge.
TEST(JoinSubmaps, SubmapsThatStayApartAreOptimisedApart) {
  SimulatedDrive drive(16);
  drive.breakAt(kLap, Eigen::Isometry3d(Eigen::Translation3d(0.0, 9.0, 0.0)));
  const Eigen::Matrix4d first = drive.graph.nodes[0].T_world_camera.matrix();
  const Eigen::Matrix4d second = drive.graph.nodes[kLap].T_world_camera.matrix();
  drive.addLoop(0, kLap - 1);
  EXPECT_EQ(joinSubmaps(drive.graph, drive.allBelieved(), {}), 2);
  ASSERT_TRUE(optimisePoseGraph(drive.graph, drive.allBelieved(), {}, {}).usable);
  EXPECT_LT((drive.graph.nodes[0].T_world_camera.matrix() - first).norm(), 1e-12);
  EXPECT_LT((drive.graph.nodes[kLap].T_world_camera.matrix() - second).norm(), 1e-12);
}

}  // namespace
}  // namespace oikos::mapping
