// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/map_frames.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/mapping/built_map.h"

namespace oikos::mapping {
namespace {

constexpr int kFirst = 30;

const Built& builtMap() {
  static const Built map(richRecording(shortDrive(kFirst, -20.0, 60.0)));
  return map;
}

TEST(MapFrames, WithoutAnEarlierMapAreTheRecordingsOwn) {
  RichRecording recording = richRecording(shortDrive(5, 0.0, 10.0));
  recording.T_odom_base = recording.truth();
  const MapFrames frames(recording, nullptr);
  EXPECT_EQ(frames.firstOfDrive(), 0);
  EXPECT_EQ(frames.addedToStampsS(), 0);
  const camera::RgbdFrame frame = frames.read(3, recording::Channels::kGray);
  EXPECT_EQ(frame.index, 3);
  EXPECT_EQ(frame.stamp_ns, recording.stampNs(3));
  EXPECT_EQ(frames.findOdometry()->front().stamp_ns, 0);
}

TEST(MapFrames, AreNumberedThroughAndTheirStampsGoOn) {
  const EarlierMap earlier(builtMap().folder.path(), {});
  RichRecording recording = richRecording(shortDrive(5, 0.0, 10.0));
  recording.T_odom_base = recording.truth();
  const MapFrames frames(recording, &earlier);
  EXPECT_EQ(frames.firstOfDrive(), kFirst);
  EXPECT_EQ(frames.addedToStampsS(), 1);  // the first drive ended after 29 / 30 s
  const camera::RgbdFrame frame = frames.read(kFirst + 2, recording::Channels::kGray);
  EXPECT_EQ(frame.index, kFirst + 2);
  EXPECT_EQ(frame.stamp_ns, recording.stampNs(2) + 1'000'000'000);
  EXPECT_EQ(frames.renumbered(recording.read(2, recording::Channels::kGray)).stamp_ns, frame.stamp_ns);
  EXPECT_EQ(frames.findOdometry()->front().stamp_ns, 1'000'000'000);
}

TEST(MapFrames, EarlierOnesAreTheSavedKeyframes) {
  const EarlierMap earlier(builtMap().folder.path(), {});
  const RichRecording recording = richRecording(shortDrive(kFirst, -20.0, 60.0));
  const MapFrames frames(recording, &earlier);
  const Node& keyframe = earlier.keyframes().graph().nodes.back();
  const camera::RgbdFrame saved = frames.read(keyframe.frame, recording::Channels::kColor);
  const camera::RgbdFrame original = recording.read(keyframe.frame, recording::Channels::kColor);
  EXPECT_EQ(saved.index, keyframe.frame);
  EXPECT_EQ(saved.stamp_ns, original.stamp_ns);
  EXPECT_LT(cv::norm(saved.color, original.color, cv::NORM_L1) / (3.0 * static_cast<double>(saved.color.total())), 4.0);  // JPEG
  cv::Mat off_m;
  cv::absdiff(saved.depth_m, original.depth_m, off_m);
  EXPECT_LT(cv::mean(off_m, off_m == off_m)[0], 2e-4);
  EXPECT_TRUE(frames.read(keyframe.frame, recording::Channels::kGray).color.empty());
  EXPECT_EQ(frames.read(keyframe.frame, recording::Channels::kGray).gray.size(), original.gray.size());
}

TEST(MapFrames, WhatIsForgottenHasNoReadings) {
  const EarlierMap earlier(builtMap().folder.path(), {});
  const RichRecording recording = richRecording(shortDrive(5, 0.0, 10.0));
  MapFrames frames(recording, &earlier);
  const Node& keyframe = earlier.keyframes().graph().nodes.front();
  const cv::Mat before = frames.read(keyframe.frame, recording::Channels::kGray).depth_m;
  const Eigen::Vector2i px(before.cols / 2, before.rows / 2);
  const camera::PinholeCamera& camera = earlier.keyframes().camera();
  const Eigen::Vector3d point_map = keyframe.T_world_camera * (camera.ray(px.x(), px.y()) * before.at<float>(px.y(), px.x()));
  std::vector<Eigen::Isometry3d> poses;
  for (const Node& node : earlier.keyframes().graph().nodes) {
    poses.push_back(node.T_world_camera);
  }
  frames.forget(GoneSpace(0.05, {*VoxelLattice(0.05).findKey(point_map.cast<float>())}), poses);
  const cv::Mat after = frames.read(keyframe.frame, recording::Channels::kGray).depth_m;
  EXPECT_FALSE(after.at<float>(px.y(), px.x()) > 0.0F);
  EXPECT_EQ(after.at<float>(0, 0), before.at<float>(0, 0));
}

}  // namespace
}  // namespace oikos::mapping
