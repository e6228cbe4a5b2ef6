// SPDX-License-Identifier: Apache-2.0
#include "core/tags/board_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/tags/board_picture.h"

namespace oikos::tags {
namespace {

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

TEST(TagDetector, CornersAreWhereTheyProject) {
  const TagBoard board;
  const BoardCamera camera = plainCamera();
  const Eigen::Isometry3d T_camera_board = placeBoard({{0.05, -0.03, 1.2}, 0.3, 0.4});
  const auto detections = TagDetector().detect(takeBoardPicture(board, camera, T_camera_board));
  ASSERT_EQ(detections.size(), 6U);
  for (std::size_t i = 0; i < detections.size(); ++i) {
    EXPECT_EQ(detections[i].id, static_cast<int>(i));
    const auto corners_board = board.findCorners(detections[i].id);
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d expected_px = camera.pinhole.project(T_camera_board * (*corners_board)[k]);
      EXPECT_LT((detections[i].corners_px[k] - expected_px).norm(), 0.15) << i << ' ' << k;
    }
  }
}

TEST(TagDetector, FindsNothingInAnEmptyPicture) {
  EXPECT_TRUE(TagDetector().detect(cv::Mat(48, 64, CV_8UC1, cv::Scalar(200))).empty());
}

TEST(TagDetector, ATagThatIsThereTwiceIsLeftOut) {
  const TagBoard board{1, 1, 4, 0.16, 2};
  const cv::Mat once = takeBoardPicture(board, plainCamera(), placeBoard({{-0.5, 0.0, 1.5}, 0.0, 0.0}));
  cv::Mat twice = once.clone();
  once(cv::Rect(0, 0, 320, 480)).copyTo(twice(cv::Rect(320, 0, 320, 480)));
  EXPECT_EQ(TagDetector().detect(once).size(), 1U);
  EXPECT_TRUE(TagDetector().detect(twice).empty());
}

struct PoseCase {
  FacingBoard board;
  double position_m;  ///< tolerance: a tenth of a pixel of 24 corners' scale is 0.1 / 525 of the distance, times distance / board for depth
  double angle_rad;
};

TEST(BoardPose, IsRecovered) {
  const TagBoard board;
  const BoardCamera distorted{{640, 480, 525.0, 525.0, 319.5, 239.5}, {0.1, -0.2, 0.001, -0.0005, 0.05}};
  for (const BoardCamera& camera : {plainCamera(), distorted}) {
    for (const PoseCase& one :
         {PoseCase{{{0.0, 0.0, 1.0}, 0.0, 0.0}, 0.001, 0.003}, PoseCase{{{0.2, 0.1, 1.5}, 0.6, 1.0}, 0.001, 0.003},
          PoseCase{{{-0.3, 0.2, 2.0}, -0.8, 3.0}, 0.003, 0.003}, PoseCase{{{0.5, -0.4, 2.5}, 0.9, -2.0}, 0.005, 0.004}}) {
      const Eigen::Isometry3d T_camera_board = placeBoard(one.board);
      const auto pose = estimateBoardPose(board, TagDetector().detect(takeBoardPicture(board, camera, T_camera_board)), camera);
      ASSERT_TRUE(pose);
      EXPECT_EQ(pose->corners, 24);
      EXPECT_LT(pose->rms_px, 0.2);
      EXPECT_LT((pose->T_camera_board.translation() - T_camera_board.translation()).norm(), one.position_m);
      EXPECT_LT(angleBetween(pose->T_camera_board, T_camera_board), one.angle_rad);
    }
  }
}

TagDetection pointDetection(int id) {
  const Eigen::Vector2d place_px(100.0, 100.0);
  return {id, {place_px, place_px, place_px, place_px}};
}

/// Without a picture: corners where they project exactly.
std::vector<TagDetection> exactDetections(const TagBoard& board, const BoardCamera& camera, const Eigen::Isometry3d& T_camera_board) {
  std::vector<TagDetection> detections;
  for (int id = board.first_id; id < board.first_id + board.tagCount(); ++id) {
    TagDetection& detection = detections.emplace_back();
    detection.id = id;
    const auto corners_board = board.findCorners(id);
    for (std::size_t k = 0; k < 4; ++k) {
      detection.corners_px[k] = camera.pinhole.project(T_camera_board * (*corners_board)[k]);
    }
  }
  return detections;
}

TEST(BoardPose, ExactCornersGiveTheExactPose) {
  const TagBoard board{2, 1, 7, 0.1, 1};
  const Eigen::Isometry3d T_camera_board = placeBoard({{0.4, 0.3, 3.0}, 0.7, -0.5});
  std::vector<TagDetection> detections = exactDetections(board, plainCamera(), T_camera_board);
  detections.push_back(pointDetection(99));  // of another board
  const auto pose = estimateBoardPose(board, detections, plainCamera());
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->corners, 8);
  EXPECT_LT(pose->rms_px, 1e-6);
  EXPECT_LT((pose->T_camera_board.translation() - T_camera_board.translation()).norm(), 1e-6);
  EXPECT_LT(angleBetween(pose->T_camera_board, T_camera_board), 1e-6);
}

TEST(BoardPose, WithoutATagOfTheBoardThereIsNone) {
  EXPECT_FALSE(estimateBoardPose(TagBoard{}, {}, plainCamera()));
  EXPECT_FALSE(estimateBoardPose(TagBoard{}, {pointDetection(99)}, plainCamera()));
}

TEST(BoardPose, CornersInOnePlaceAreNone) {
  EXPECT_FALSE(estimateBoardPose(TagBoard{}, {pointDetection(0), pointDetection(1)}, plainCamera()));
}

}  // namespace
}  // namespace oikos::tags
