// SPDX-License-Identifier: Apache-2.0
// The real recordings are not part of the repository: OIKOS_DATA names the folder that holds them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "core/base/read_file.h"
#include "core/recording/frame_stream.h"
#include "core/recording/inspect/inspection.h"
#include "core/recording/recording.h"
#include "tests/support/temporary_folder.h"

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

/// How each of the recordings is judged, and why.
TEST(InspectReal, Kitchen) {
  const auto folder = findData("kitchen");
  if (folder.empty()) {
    GTEST_SKIP() << "SKIPPED: inspection of 'kitchen' was NOT tested; set OIKOS_DATA to the folder that holds it";
  }
  const Inspection inspection = inspect(*openRecording(folder));
  EXPECT_EQ(inspection.verdict, Verdict::kGood) << toText(inspection);
  EXPECT_NEAR(inspection.rate.rate_hz, 30.0, 0.01);
  EXPECT_EQ(inspection.rate.lost, 0);
  ASSERT_TRUE(inspection.edges.is_known_u && inspection.edges.is_known_v);
  EXPECT_LT(std::hypot(inspection.edges.shift_u_px, inspection.edges.shift_v_px), 1.0);
  EXPECT_TRUE(inspection.floor.is_seen);
}

TEST(InspectReal, KitchenWithACalibrationTwoCentimetresOff) {
  const auto folder = findData("kitchen");
  if (folder.empty()) {
    GTEST_SKIP() << "SKIPPED: a wrong calibration of 'kitchen' was NOT tested; set OIKOS_DATA to the folder that holds it";
  }
  for (const auto& [right, wrong] :
       {std::pair<std::string, std::string>{"-0.032,", "-0.012,"}, {"-0.032,", "-0.052,"}, {"0.0076,", "0.0276,"}}) {
    const test::TemporaryFolder copy;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename() != "camera.toml") {
        std::filesystem::create_symlink(entry.path(), copy.path() / entry.path().filename());
      }
    }
    std::string calibration = base::readFile(folder / "camera.toml");
    ASSERT_NE(calibration.find(right), std::string::npos);
    copy.write("camera.toml", calibration.replace(calibration.find(right), right.size(), wrong));
    InspectionConfig config;
    config.max_frames = 240;
    const Inspection inspection = inspect(*openRecording(copy.path()), config);
    EXPECT_EQ(inspection.verdict, Verdict::kBad) << wrong << "\n" << toText(inspection);
    EXPECT_GT(std::hypot(inspection.edges.shift_u_px, inspection.edges.shift_v_px), 4.0) << wrong;
  }
}

TEST(InspectReal, DeskIsTurnedTooFast) {
  const auto folder = findData("desk-rpy");
  if (folder.empty()) {
    GTEST_SKIP() << "SKIPPED: inspection of 'desk-rpy' was NOT tested; set OIKOS_DATA to the folder that holds it";
  }
  const Inspection inspection = inspect(*openRecording(folder));
  EXPECT_NE(inspection.verdict, Verdict::kGood) << toText(inspection);
  EXPECT_GT(inspection.motion.fast_rad_s, 1.2);
  EXPECT_GT(inspection.blurred.size(), 70U);
}

TEST(InspectReal, HouseholdBoxIsUsable) {
  const auto folder = findData("household-box");
  if (folder.empty()) {
    GTEST_SKIP() << "SKIPPED: inspection of 'household-box' was NOT tested; set OIKOS_DATA to the folder that holds it";
  }
  const Inspection inspection = inspect(*openRecording(folder));
  EXPECT_EQ(inspection.verdict, Verdict::kUsable) << toText(inspection);
  EXPECT_LT(inspection.valid_depth_share, 0.5);
  EXPECT_EQ(inspection.blurred.size(), 0U);
}

}  // namespace
}  // namespace oikos::recording
