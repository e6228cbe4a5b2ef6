// SPDX-License-Identifier: Apache-2.0
// The real recordings are not part of the repository: OIKOS_DATA names the folder that holds them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>

#include "core/recording/frame_stream.h"
#include "core/recording/recording.h"

namespace oikos::recording {
namespace {

std::filesystem::path findData(const std::string& name) {
  const char* data = std::getenv("OIKOS_DATA");
  const std::filesystem::path folder = data == nullptr ? std::filesystem::path() : std::filesystem::path(data) / name;
  return !folder.empty() && std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

struct Expected {
  const char* name;
  int frames;
  double least_valid_depth;
};

class RealRecording : public testing::TestWithParam<Expected> {};

TEST_P(RealRecording, AllFramesAreRead) {
  const auto folder = findData(GetParam().name);
  if (folder.empty()) {
    GTEST_SKIP() << "SKIPPED: reading of the real recording '" << GetParam().name
                 << "' was NOT tested; set OIKOS_DATA to the folder that holds it";
  }
  const auto recording = openRecording(folder);
  EXPECT_EQ(recording->frameCount(), GetParam().frames);
  FrameStreamConfig config;
  config.stride = 5;
  FrameStream stream(*recording, config);
  double valid = 0.0;
  while (const auto frame = stream.next()) {
    EXPECT_EQ(frame->gray.size(), cv::Size(640, 480));
    EXPECT_EQ(frame->depth_m.size(), cv::Size(640, 480));
    valid += cv::countNonZero(frame->depth_m > 0.1F) / (640.0 * 480.0);
  }
  EXPECT_EQ(stream.statistics().unreadable, 0);
  EXPECT_GT(valid / stream.statistics().read, GetParam().least_valid_depth);
}

INSTANTIATE_TEST_SUITE_P(OikosData, RealRecording,
                         testing::Values(Expected{"kitchen", 600, 0.6}, Expected{"desk-rpy", 350, 0.5}, Expected{"household-box", 50, 0.3}),
                         [](const auto& expected) {
                           std::string name = expected.param.name;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace oikos::recording
