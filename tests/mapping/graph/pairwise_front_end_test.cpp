// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/pairwise_front_end.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/graph/frame_poses.h"
#include "tests/mapping/graph/synthetic_drive.h"

namespace oikos::mapping {
namespace {

FrontEndResult drivePairwise(const test::SyntheticRecording& recording, const PairwiseConfig& config = {}, std::uint64_t seed = 1) {
  PairwiseFrontEnd front_end(recording.camera(), config, {}, {}, seed);
  for (int i = 0; i < recording.frameCount(); ++i) {
    front_end.add(recording.read(i, recording::Channels::kGray));
  }
  return front_end.finish();
}

test::SyntheticRecording recordingOf(const std::vector<Eigen::Isometry3d>& drive, const std::set<int>& blank_frames = {}) {
  test::SyntheticSensor sensor;
  sensor.blank_frames = blank_frames;
  return test::SyntheticRecording(test::TexturedWorld::furnished(), test::texturedCamera(), drive, sensor);
}

TEST(PairwiseFrontEnd, FollowsADriveWithinDrift) {
  const auto recording = recordingOf(turnAround(0.0, 90.0, 24));
  const FrontEndResult drive = drivePairwise(recording);
  ASSERT_EQ(drive.frames.size(), 24U);
  EXPECT_EQ(drive.lost_frames, 0);
  EXPECT_EQ(drive.submaps, 1);
  const std::vector<Eigen::Isometry3d> poses = posesFromReferences(drive.graph, drive.frames);
  const recording::Trajectory truth = recording.truth();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Isometry3d T_first_frame = truth[0].T_map_camera.inverse() * truth[i].T_map_camera;
    EXPECT_LT((poses[0].inverse() * poses[i] * T_first_frame.inverse()).translation().norm(), 0.1) << "frame " << i;
  }
}

TEST(PairwiseFrontEnd, ANodeHasEdgesToAtMostItsPredecessorsAndTheDrawn) {
  const FrontEndResult drive = drivePairwise(recordingOf(turnAround(0.0, 120.0, 40)), {.keyframe_overlap = 1.0});
  ASSERT_GT(drive.graph.nodes.size(), 10U);
  std::vector<int> near(drive.graph.nodes.size(), 0);
  std::vector<int> drawn(drive.graph.nodes.size(), 0);
  for (const Edge& edge : drive.graph.edges) {
    ++(edge.kind == EdgeKind::kOdometry ? near : drawn)[static_cast<std::size_t>(edge.to)];
    const int steps = edge.to - edge.from;
    EXPECT_TRUE(edge.kind == EdgeKind::kOdometry ? steps <= 5 : steps > 5) << edge.from << " to " << edge.to;
  }
  EXPECT_EQ(*std::max_element(near.begin(), near.end()), 5);
  EXPECT_LE(*std::max_element(drawn.begin(), drawn.end()), 5);
  EXPECT_GT(*std::max_element(drawn.begin(), drawn.end()), 0);
}

TEST(PairwiseFrontEnd, TheSameSeedDrawsTheSame) {
  const auto recording = recordingOf(turnAround(0.0, 120.0, 30));
  const FrontEndResult first = drivePairwise(recording, {.keyframe_overlap = 1.0}, 7);
  const FrontEndResult second = drivePairwise(recording, {.keyframe_overlap = 1.0}, 7);
  ASSERT_EQ(first.graph.edges.size(), second.graph.edges.size());
  for (std::size_t e = 0; e < first.graph.edges.size(); ++e) {
    EXPECT_EQ(first.graph.edges[e].from, second.graph.edges[e].from);
    EXPECT_EQ(first.graph.edges[e].T_from_to.matrix(), second.graph.edges[e].T_from_to.matrix());
  }
}

TEST(PairwiseFrontEnd, ACoveredLensIsLostAndCounted) {
  const FrontEndResult drive = drivePairwise(recordingOf(turnAround(0.0, 60.0, 20), {8, 9, 10}));
  EXPECT_EQ(drive.lost_frames, 3);
  for (const int frame : {8, 9, 10}) {
    EXPECT_EQ(drive.frames[static_cast<std::size_t>(frame)].status, TrackingStatus::kLost);
  }
}

TEST(PairwiseFrontEnd, WrongParametersAreNamed) {
  EXPECT_TRUE(PairwiseConfig{}.validate().empty());
  EXPECT_EQ(PairwiseConfig{.predecessors = 0}.validate().front(), "predecessors = 0: must be >= 1");
  EXPECT_EQ(PairwiseConfig{.keyframe_overlap = 2.0}.validate().front(), "keyframe_overlap = 2: must be from 0 to 1");
}

}  // namespace
}  // namespace oikos::mapping
