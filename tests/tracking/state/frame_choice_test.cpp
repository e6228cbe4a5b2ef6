// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/frame_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace oikos::tracking {
namespace {

/// Ten frames a second; worth of piece 1 in each, 0: out of view.
std::vector<SeenFrame> framesOf(const std::vector<double>& worth) {
  std::vector<SeenFrame> frames;
  for (std::size_t i = 0; i < worth.size(); ++i) {
    SeenFrame frame;
    frame.frame = static_cast<int>(10 * i);
    frame.stamp_ns = static_cast<std::int64_t>(i) * 100'000'000;
    frame.sights.push_back({0, 1.0});
    if (worth[i] > 0.0) {
      frame.sights.push_back({1, worth[i]});
    }
    frames.push_back(frame);
  }
  return frames;
}

FrameChoiceConfig everySecond(int most) {
  FrameChoiceConfig config;
  config.spacing_s = 1.0;
  config.most_frames = most;
  config.gap_s = 2.0;
  return config;
}

TEST(FrameChoice, TheBestOfEachTime) {
  std::vector<double> worth(30, 1.0);
  worth[4] = 5.0;
  worth[17] = 3.0;
  worth[18] = 3.0;  // the first of equals
  worth[29] = 2.0;
  EXPECT_EQ(chooseFrames(framesOf(worth), 1, everySecond(8)), (std::vector<int>{4, 17, 29}));
  EXPECT_EQ(chooseFrames(framesOf(worth), 1, everySecond(1)), (std::vector<int>{4}));
}

TEST(FrameChoice, EachStayInViewByItself) {
  std::vector<double> worth(60, 0.0);
  worth[3] = 1.0;
  worth[5] = 2.0;
  worth[50] = 1.0;
  EXPECT_EQ(chooseFrames(framesOf(worth), 1, everySecond(8)), (std::vector<int>{5, 50}));
  EXPECT_TRUE(chooseFrames(framesOf(worth), 2, everySecond(8)).empty());
  EXPECT_TRUE(chooseFrames({}, 1, everySecond(8)).empty());
}

TEST(FrameChoice, BetweenTwoFramesTheMiddleOneThatSeesThePiece) {
  std::vector<double> worth(20, 1.0);
  worth[10] = 0.0;
  EXPECT_EQ(frameBetween(framesOf(worth), 1, 5, 15), 9);
  EXPECT_EQ(frameBetween(framesOf(worth), 1, 5, 6), std::nullopt);
  EXPECT_EQ(frameBetween(framesOf(worth), 1, 9, 11), std::nullopt);
}

TEST(FrameChoice, BesideAFrameTheNearestThatWasNotRead) {
  std::vector<double> worth(40, 0.0);
  worth[10] = worth[11] = worth[14] = worth[30] = 1.0;
  EXPECT_EQ(frameBeside(framesOf(worth), 1, {10}, 10), 11);
  EXPECT_EQ(frameBeside(framesOf(worth), 1, {10, 11}, 10), 14);
  EXPECT_EQ(frameBeside(framesOf(worth), 1, {10, 11, 14}, 10), std::nullopt);  // the next is two seconds away
}

TEST(FrameChoice, RulesAreChecked) {
  EXPECT_TRUE(FrameChoiceConfig().validate().empty());
  FrameChoiceConfig config;
  config.most_hz = 0.0;
  config.whole_weight = 2.0;
  EXPECT_EQ(config.validate(), (std::vector<std::string>{"most_hz = 0: must be > 0", "whole_weight = 2: must be from 0 to 1"}));
}

}  // namespace
}  // namespace oikos::tracking
