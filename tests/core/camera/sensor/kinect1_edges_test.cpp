// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/camera/sensor/kinect1.h"
#include "tests/core/camera/sensor/flat_scene.h"
#include "tests/core/camera/sensor/running_moments.h"

namespace oikos::camera {
namespace {

using test::FlatScene;
using test::RunningMoments;

constexpr PinholeCamera kCamera = {320, 240, 525.0, 525.0, 159.5, 119.5};
constexpr double kWall_m = 2.0;
constexpr double kBoard_m = 1.0;
constexpr double kFocalBaseline = 525.0 * 0.075;
/// Rows that no upper or lower edge reaches.
constexpr int kFirstRow = 60;
constexpr int kLastRow = 180;

FlatScene boardBeforeWall(const cv::Rect& board) {
  FlatScene scene(kCamera);
  scene.addPlane(kWall_m, 0.0).addBoard(board, kBoard_m);
  return scene;
}

bool isBoard(float depth_m) {
  return std::abs(depth_m - 1.0F) < 0.1F;
}

bool isWall(float depth_m) {
  return std::abs(depth_m - 2.0F) < 0.2F;
}

/// Pixels of [first, last) without a reading.
int countHoles(const float* row, int first, int last) {
  int holes = 0;
  for (int u = first; u < last; ++u) {
    holes += std::isnan(row[u]) ? 1 : 0;
  }
  return holes;
}

TEST(Kinect1Edges, TheShadowIsAsWideAsTheDisparitiesDifferAndOnTheLeft) {
  RunningMoments excess;
  RunningMoments right;
  for (int frame = 0; frame < 20; ++frame) {
    const double wall_m = 1.8 + 0.02 * frame;  // whole pixels: right on average over many distances
    const double board_m = 1.0 + 0.007 * frame;
    FlatScene scene(kCamera);
    scene.addPlane(wall_m, 0.0).addBoard({120, 0, 100, 240}, board_m);
    const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, {}, {1, frame, 1});
    const double expected_px = kFocalBaseline * (1.0 / board_m - 1.0 / wall_m);
    for (int v = kFirstRow; v < kLastRow; ++v) {
      excess.add(countHoles(depth_m.ptr<float>(v), 80, 140) - expected_px);
      right.add(countHoles(depth_m.ptr<float>(v), 200, 260));
    }
  }
  // 20 pairs of distances, each rounded to whole pixels twice: 0.29 * sqrt(2 / 20), 3.5 times
  EXPECT_NEAR(excess.mean(), 0.0, 0.33);
  EXPECT_LT(right.mean(), 0.05);
}

TEST(Kinect1Edges, WithoutNoiseTheShadowEndsAtTheBoard) {
  const FlatScene scene = boardBeforeWall({120, 0, 100, 240});
  Kinect1Config config;
  config.noise_scale = 0.0;
  const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, config, {1, 0, 1});
  const float* row = depth_m.ptr<float>(120);
  EXPECT_TRUE(isWall(row[99]));
  EXPECT_EQ(countHoles(row, 101, 120), 19);
  EXPECT_TRUE(isBoard(row[120]));
  EXPECT_TRUE(isBoard(row[219]));
  EXPECT_TRUE(isWall(row[220]));
}

TEST(Kinect1Edges, AnEdgeWaversByThePublishedDeviation) {
  const FlatScene scene = boardBeforeWall({120, 0, 100, 240});
  RunningMoments edge_px;
  for (int frame = 0; frame < 40; ++frame) {
    const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, {}, {2, frame, 1});
    for (int v = kFirstRow; v < kLastRow; ++v) {
      int board = 0;
      for (int u = 200; u < 240; ++u) {
        board += isBoard(depth_m.at<float>(v, u)) ? 1 : 0;
      }
      edge_px.add(board);
    }
  }
  EXPECT_NEAR(edge_px.mean(), 20.0, 0.15);
  EXPECT_NEAR(edge_px.deviation(), kinect1LateralSigma_px(0.0), 0.1);
}

double shareOfBar(int width_px) {
  const FlatScene scene = boardBeforeWall({160, 0, width_px, 240});
  double share = 0.0;
  for (int frame = 0; frame < 5; ++frame) {
    const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, {}, {3, frame, 1});
    for (int v = kFirstRow; v < kLastRow; ++v) {
      for (int u = 150; u < 180; ++u) {
        share += isBoard(depth_m.at<float>(v, u)) ? 1.0 : 0.0;
      }
    }
  }
  return share / (5.0 * (kLastRow - kFirstRow) * width_px);
}

TEST(Kinect1Edges, ABarIsSeenOnlyIfItFillsHalfOfTheWindow) {
  EXPECT_EQ(shareOfBar(2), 0.0);
  EXPECT_EQ(shareOfBar(4), 0.0);
  EXPECT_GT(shareOfBar(6), 0.8);
  EXPECT_NEAR(shareOfBar(12), 1.0, 0.05);
}

TEST(Kinect1Edges, ALowStepIsBlurredOverTheWindow) {
  FlatScene scene(kCamera);
  const double front_m = kFocalBaseline / (kFocalBaseline / kWall_m + 1.0);  // one pixel of disparity: the matcher sees one surface
  scene.addPlane(kWall_m, 0.0).addBoard({160, 0, 160, 240}, front_m);
  Kinect1Config config;
  config.noise_scale = 0.0;
  config.disparity_step_px = 0.01;
  const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, config, {1, 0, 1});
  for (int u = 150; u < 170; ++u) {
    const double share = std::clamp((u - 155.0) / 9.0, 0.0, 1.0);  // of the window's columns on the board
    EXPECT_NEAR(kFocalBaseline / static_cast<double>(depth_m.at<float>(120, u)), kFocalBaseline / kWall_m + share, 0.02) << u;
  }
}

TEST(Kinect1Edges, ASlantedBoardCastsNoShadowOnItself) {
  for (const double theta_rad : {-1.0, 1.0}) {
    FlatScene scene(kCamera);
    scene.addPlane(1.2, theta_rad);
    const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, {}, {1, 0, 1});
    int holes = 0;
    int inside = 0;
    for (int v = kFirstRow; v < kLastRow; ++v) {
      for (int u = 4; u < kCamera.width - 4; ++u) {
        const float truth_m = scene.view().depth_m.at<float>(v, u);
        const bool is_within = truth_m > 0.6F && truth_m < 4.0F;
        inside += is_within ? 1 : 0;
        holes += is_within && std::isnan(depth_m.at<float>(v, u)) ? 1 : 0;
      }
    }
    EXPECT_LT(holes, inside / 200);
  }
}

}  // namespace
}  // namespace oikos::camera
