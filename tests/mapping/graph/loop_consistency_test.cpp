// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/loop_consistency.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/mapping/graph/simulated_drive.h"

namespace oikos::mapping {
namespace {

constexpr int kLap = SimulatedDrive::kNodesPerLap;

/// True loops between the laps, `step` nodes apart.
std::vector<std::size_t> closeLaps(SimulatedDrive& drive, int step) {
  std::vector<std::size_t> edges;
  for (int n = 0; n < kLap; n += step) {
    edges.push_back(drive.addLoop(n, n + kLap));
  }
  return edges;
}

int countBelieved(const std::vector<char>& believed, const std::vector<std::size_t>& edges) {
  int count = 0;
  for (const std::size_t e : edges) {
    count += believed[e] != 0 ? 1 : 0;
  }
  return count;
}

Eigen::Isometry3d shiftBy(double x_m, double y_m, double z_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(x_m, y_m, z_m));
}

TEST(LoopConsistency, OdometryIsAlwaysBelieved) {
  const SimulatedDrive drive(1);
  for (const char believed : consistentEdges(drive.graph, {}, {})) {
    EXPECT_NE(believed, 0);
  }
}

TEST(LoopConsistency, BelievesTrueLoopsInSpiteOfDrift) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SimulatedDrive drive(seed);
    const auto loops = closeLaps(drive, 2);
    EXPECT_EQ(countBelieved(consistentEdges(drive.graph, {}, {}), loops), static_cast<int>(loops.size())) << "seed " << seed;
  }
}

TEST(LoopConsistency, DropsASingleWrongLoop) {
  SimulatedDrive drive(2);
  const auto loops = closeLaps(drive, 4);
  const std::size_t wrong = drive.addWrongLoop(5, 25, Eigen::Isometry3d::Identity());  // opposite sides taken for one
  const auto believed = consistentEdges(drive.graph, {}, {});
  EXPECT_EQ(believed[wrong], 0);
  EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size()));
}

TEST(LoopConsistency, DropsWrongLoopsThatAreThreeInTen) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SimulatedDrive drive(seed);
    const auto loops = closeLaps(drive, 2);                                                    // 20 true ones,
    const auto wrong = drive.addRandomWrongLoops(static_cast<int>(loops.size()) * 3 / 7 + 1);  // 9 of 29 wrong
    const auto believed = consistentEdges(drive.graph, {}, {});
    EXPECT_EQ(countBelieved(believed, wrong), 0) << "seed " << seed;
    EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size())) << "seed " << seed;
  }
}

TEST(LoopConsistency, DropsAPairOfWrongLoopsThatAgreeWithEachOther) {
  SimulatedDrive drive(3);
  const auto loops = closeLaps(drive, 5);
  const Eigen::Isometry3d T_5_25 = shiftBy(0.1, 0.0, 0.2);
  const Eigen::Isometry3d T_6_26 = drive.trueMotion(6, 5) * T_5_25 * drive.trueMotion(25, 26);
  const auto wrong = {drive.addWrongLoop(5, 25, T_5_25), drive.addWrongLoop(6, 26, T_6_26)};
  const auto believed = consistentEdges(drive.graph, {}, {});
  EXPECT_EQ(countBelieved(believed, wrong), 0);
  EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size()));
}

/// Two sides of the square look alike: seven views of one are taken for views of the other.
TEST(LoopConsistency, DropsAPlaceTakenForItsTwin) {
  SimulatedDrive drive(4);
  const auto loops = closeLaps(drive, 3);
  std::vector<std::size_t> wrong;
  for (int n = 2; n < 9; ++n) {
    wrong.push_back(drive.addWrongLoop(n, n + 10, Eigen::Isometry3d::Identity()));
  }
  const auto believed = consistentEdges(drive.graph, {}, {});
  EXPECT_EQ(countBelieved(believed, wrong), 0);
  EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size()));
}

TEST(LoopConsistency, BelievesALoneLoopThatTheOdometryBears) {
  SimulatedDrive drive(5);
  const std::size_t loop = drive.addLoop(3, 3 + kLap);
  EXPECT_NE(consistentEdges(drive.graph, {}, {})[loop], 0);
}

TEST(LoopConsistency, DoubtsALoneLoopThatTheOdometryContradicts) {
  SimulatedDrive drive(5);
  const std::size_t far = drive.addWrongLoop(5, 15, Eigen::Isometry3d::Identity());
  EXPECT_EQ(consistentEdges(drive.graph, {}, {})[far], 0);
}

TEST(LoopConsistency, ALoneLoopMayJoinTwoSubmapsIfItIsStrong) {
  SimulatedDrive drive(6);
  drive.breakAt(kLap, shiftBy(7.0, 0.0, 0.0));
  const std::size_t loop = drive.addLoop(4, 4 + kLap);
  drive.graph.edges[loop].inliers = 40;
  EXPECT_NE(consistentEdges(drive.graph, {}, {}, 40)[loop], 0);
  drive.graph.edges[loop].inliers = 39;
  EXPECT_EQ(consistentEdges(drive.graph, {}, {}, 40)[loop], 0);
}

TEST(LoopConsistency, LoopsBetweenSubmapsAreJudgedByEachOther) {
  SimulatedDrive drive(7);
  drive.breakAt(kLap, Eigen::Isometry3d(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ())));
  const auto loops = closeLaps(drive, 8);
  const std::size_t wrong = drive.addWrongLoop(5, kLap + 25, Eigen::Isometry3d::Identity());
  const auto believed = consistentEdges(drive.graph, {}, {});
  EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size()));
  EXPECT_EQ(believed[wrong], 0);
}

/// A drive that changes between two sub-maps makes loops in both directions; they speak of the same thing.
TEST(LoopConsistency, LoopsBetweenSubmapsAreJudgedTogetherInBothDirections) {
  SimulatedDrive drive(8);
  drive.breakAt(kLap, shiftBy(0.0, 5.0, 0.0));
  const auto loops = closeLaps(drive, 8);
  const std::size_t back = drive.addLoop(kLap + 12, 12);
  const std::size_t wrong = drive.addWrongLoop(kLap + 25, 5, Eigen::Isometry3d::Identity());
  const auto believed = consistentEdges(drive.graph, {}, {});
  EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size()));
  EXPECT_NE(believed[back], 0);
  EXPECT_EQ(believed[wrong], 0);
}

/// A hall that looks the same at both ends: many loops agree with one another that it is short, and no true one speaks against them.
TEST(LoopConsistency, LoopsThatAgreeOnALookAlikeHaveNoSay) {
  SimulatedDrive drive(10);
  std::vector<std::size_t> wrong;
  for (int n = 2; n < 9; ++n) {
    wrong.push_back(drive.addWrongLoop(n, n + 20, drive.trueMotion(n, n + 5)));
  }
  EXPECT_EQ(countBelieved(consistentEdges(drive.graph, {}, {}), wrong), 0);
}

/// Tracking was lost on the way, and only the wheels know how far it was.
TEST(LoopConsistency, WheelsContradictLoopsBetweenTheSubmapsThatTheyJoin) {
  SimulatedDrive drive(11);
  drive.breakAt(kLap, shiftBy(0.0, 9.0, 0.0));
  std::vector<std::size_t> wrong;
  for (int n = 2; n < 9; ++n) {
    wrong.push_back(drive.addWrongLoop(n, kLap + n + 10, drive.trueMotion(n, n + 1)));
  }
  EXPECT_GE(countBelieved(consistentEdges(drive.graph, {}, {}), wrong), 6);  // nothing else can tell
  const std::vector<MotionPrior> wheels = {{kLap - 1, kLap, drive.trueMotion(kLap - 1, kLap)}};
  EXPECT_EQ(countBelieved(consistentEdges(drive.graph, wheels, {}), wrong), 0);
  const auto loops = closeLaps(drive, 8);
  EXPECT_EQ(countBelieved(consistentEdges(drive.graph, wheels, {}), loops), static_cast<int>(loops.size()));
}

TEST(LoopConsistency, AnOdometryEdgeBackwardsBreaksTheContract) {
  SimulatedDrive drive(9);
  std::swap(drive.graph.edges[3].from, drive.graph.edges[3].to);
  EXPECT_THROW(static_cast<void>(consistentEdges(drive.graph, {}, {})), base::ContractViolation);
}

/// The first lap is a map, the second a drive in a world of its own.
SimulatedDrive driveBesideAMap(unsigned seed) {
  SimulatedDrive drive(seed);
  Eigen::Isometry3d T_own_world = shiftBy(3.0, -2.0, 0.5);
  T_own_world.rotate(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()));
  drive.breakAt(kLap, T_own_world);
  drive.graph.settled = kLap;
  return drive;
}

TEST(IsConfirmed, LoopsOfSeveralViewsThatAgree) {
  SimulatedDrive drive = driveBesideAMap(5);
  const Edge first = drive.graph.edges[drive.addLoop(0, kLap)];
  EXPECT_TRUE(isConfirmed(drive.graph, first, 1, {}));
  EXPECT_FALSE(isConfirmed(drive.graph, first, 2, {}));
  (void)drive.addLoop(1, kLap);  // of the same view
  EXPECT_FALSE(isConfirmed(drive.graph, first, 2, {}));
  (void)drive.addLoop(3, kLap + 3);
  EXPECT_TRUE(isConfirmed(drive.graph, first, 2, {}));
  const Edge third = drive.graph.edges[drive.addLoop(6, kLap + 6)];
  EXPECT_TRUE(isConfirmed(drive.graph, third, 3, {}));
}

TEST(IsConfirmed, LoopsThatContradictConfirmNothing) {
  SimulatedDrive drive = driveBesideAMap(6);
  const Edge loop = drive.graph.edges[drive.addLoop(0, kLap)];
  (void)drive.addWrongLoop(20, kLap + 3, Eigen::Isometry3d::Identity());
  (void)drive.addWrongLoop(30, kLap + 6, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(isConfirmed(drive.graph, loop, 2, {}));
}

TEST(LoopConsistency, ALoneLoopJoinsNothingToAMap) {
  SimulatedDrive drive = driveBesideAMap(7);
  const std::size_t lone = drive.addLoop(5, kLap + 5);
  drive.graph.edges[lone].inliers = 500;
  EXPECT_EQ(consistentEdges(drive.graph, {}, {})[lone], 0);
  drive.graph.settled = 0;
  EXPECT_NE(consistentEdges(drive.graph, {}, {})[lone], 0);  // between two stretches of one drive it would
}

/// However long the way was between two places of a map, it is off by no more: what a drive of that length would excuse is not.
TEST(LoopConsistency, AMapIsNoLongWay) {
  SimulatedDrive drive = driveBesideAMap(8);
  std::vector<std::size_t> loops;
  for (int n = 0; n < 12; n += 2) {
    loops.push_back(drive.addLoop(n, kLap + n));
  }
  Eigen::Isometry3d off = drive.trueMotion(30, kLap + 11);
  off.pretranslate(Eigen::Vector3d(0.4, 0.0, 0.0));
  const std::size_t wrong = drive.addWrongLoop(30, kLap + 11, off);
  const auto believed = consistentEdges(drive.graph, {}, {});
  EXPECT_EQ(countBelieved(believed, loops), static_cast<int>(loops.size()));
  EXPECT_EQ(believed[wrong], 0);
}

}  // namespace
}  // namespace oikos::mapping
