// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/lost_frames.h"

#include <gtest/gtest.h>

namespace oikos::mapping {
namespace {

struct Drive {
  KeyframeGraph graph;
  std::vector<TrackedFrame> frames;
  std::vector<Eigen::Isometry3d> T_world_frame;

  /// A frame a second later than the last, at x metres; on a node of this sub-map.
  void add(TrackingStatus status, double x_m, int submap = 0) {
    TrackedFrame frame;
    frame.frame = static_cast<int>(frames.size());
    frame.stamp_ns = std::int64_t{frame.frame} * 1'000'000'000;
    frame.status = status;
    frame.reference = static_cast<int>(graph.nodes.size());
    frames.push_back(frame);
    graph.nodes.emplace_back().submap = submap;
    T_world_frame.emplace_back(Eigen::Translation3d(x_m, 0.0, 0.0));
  }
  [[nodiscard]] double x_m(std::size_t i) const { return T_world_frame[i].translation().x(); }
};

using enum TrackingStatus;

TEST(BridgeLostFrames, LieBetweenThoseAboutThemInProportionToTime) {
  Drive drive;
  drive.add(kStart, 0.0);
  drive.add(kLost, 99.0);
  drive.add(kLost, 99.0);
  drive.add(kLost, 99.0);
  drive.add(kRelocalised, 4.0);
  drive.frames[1].stamp_ns = 500'000'000;
  bridgeLostFrames(drive.graph, drive.frames, drive.T_world_frame);
  EXPECT_NEAR(drive.x_m(1), 0.5, 1e-12);
  EXPECT_NEAR(drive.x_m(2), 2.0, 1e-12);
  EXPECT_NEAR(drive.x_m(3), 3.0, 1e-12);
  EXPECT_NEAR(drive.x_m(4), 4.0, 1e-12);
}

TEST(BridgeLostFrames, KeepTheNearestPoseAtTheEnds) {
  Drive drive;
  drive.add(kLost, 99.0);
  drive.add(kStart, 1.0);
  drive.add(kTracked, 2.0);
  drive.add(kLost, 99.0);
  drive.add(kLost, 99.0);
  bridgeLostFrames(drive.graph, drive.frames, drive.T_world_frame);
  EXPECT_EQ(drive.x_m(0), 1.0);
  EXPECT_EQ(drive.x_m(3), 2.0);
  EXPECT_EQ(drive.x_m(4), 2.0);
}

TEST(BridgeLostFrames, StayInTheSubmapThatTheyWereLostIn) {
  Drive drive;
  drive.add(kStart, 0.0, 0);
  drive.add(kLost, 99.0, 0);
  drive.add(kStart, 10.0, 1);
  bridgeLostFrames(drive.graph, drive.frames, drive.T_world_frame);
  EXPECT_EQ(drive.x_m(1), 0.0);
}

TEST(BridgeLostFrames, AnAllLostDriveStaysAsItIs) {
  Drive drive;
  drive.add(kLost, 3.0);
  drive.add(kLost, 3.0);
  bridgeLostFrames(drive.graph, drive.frames, drive.T_world_frame);
  EXPECT_EQ(drive.x_m(0), 3.0);
  EXPECT_EQ(drive.x_m(1), 3.0);
}

}  // namespace
}  // namespace oikos::mapping
