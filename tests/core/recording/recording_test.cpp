// SPDX-License-Identifier: Apache-2.0
#include "core/recording/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/recording/image_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_recording.h"
#include "tests/support/temporary_folder.h"

namespace oikos::recording {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;
using test::expectError;

class RecordingFolder : public testing::Test {
 protected:
  void expectOpenFails(ErrorCode code, const std::vector<std::string>& parts) const {
    expectError(code, parts, [this] { (void)openRecording(path_); });
  }
  void expectReadFails(int index, const std::vector<std::string>& parts) const {
    const auto recording = openRecording(path_);
    expectError(ErrorCode::kInput, parts, [&] { (void)recording->read(index, Channels::kGray); });
  }
  test::TemporaryFolder folder_;
  fs::path path_ = folder_.path();
};

class TumFolder : public RecordingFolder {};
class SevenScenesFolder : public RecordingFolder {};

TEST_F(TumFolder, ReadsFrames) {
  test::writeTumRecording(path_, 3);
  const auto recording = openRecording(path_);
  EXPECT_EQ(recording->frameCount(), 3);
  EXPECT_EQ(recording->stampNs(2), 200000000);
  EXPECT_EQ(recording->camera().fx, 50.0);
  const camera::RgbdFrame gray = recording->read(1, Channels::kGray);
  EXPECT_EQ(gray.index, 1);
  EXPECT_EQ(gray.stamp_ns, 100000000);
  EXPECT_TRUE(gray.color.empty());
  EXPECT_EQ(cv::norm(gray.gray, readGrayImage(path_ / "rgb/1.jpg"), cv::NORM_INF), 0.0);
  EXPECT_FLOAT_EQ(gray.depth_m.at<float>(20, 30), 1.001F);
  const camera::RgbdFrame color = recording->read(1, Channels::kColor);
  EXPECT_EQ(cv::norm(color.gray, gray.gray, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(color.color, readColorImage(path_ / "rgb/1.jpg"), cv::NORM_INF), 0.0);
  EXPECT_THROW((void)recording->read(3, Channels::kGray), base::ContractViolation);
}

TEST_F(TumFolder, CountsWhatIsMissingOrDouble) {
  test::writeTumRecording(path_, 4);
  test::append(path_ / "rgb.txt", "0.3 rgb/3.jpg\n0.9 rgb/late.jpg\n");
  test::append(path_ / "depth.txt", "2.0 depth/a.png\n2.0 depth/b.png\n2.1 depth/c.png\n");
  const ListingStatistics statistics = openRecording(path_)->listing();
  EXPECT_EQ(statistics.listed_color, 6);
  EXPECT_EQ(statistics.duplicate_color, 1);
  EXPECT_EQ(statistics.unmatched_color, 1);
  EXPECT_EQ(statistics.listed_depth, 7);
  EXPECT_EQ(statistics.duplicate_depth, 1);
  EXPECT_EQ(statistics.unmatched_depth, 2);
}

TEST_F(TumFolder, ListsThatAreWrong) {
  test::writeTumRecording(path_, 2);
  test::append(path_ / "rgb.txt", "0.05 rgb/0.jpg\n");
  expectOpenFails(ErrorCode::kInput, {"rgb.txt:4", "0.050000 is out of order", "0.100000"});
  fs::remove(path_ / "rgb.txt");
  expectOpenFails(ErrorCode::kInput, {"no rgb.txt"});
  folder_.write("rgb.txt", "# nothing\n");
  expectOpenFails(ErrorCode::kInput, {"rgb.txt", "list is empty"});
  folder_.write("rgb.txt", "# c\n0.0\n");
  expectOpenFails(ErrorCode::kInput, {"rgb.txt:2", "stamp file"});
  folder_.write("rgb.txt", "zero rgb/0.jpg\n");
  expectOpenFails(ErrorCode::kInput, {"rgb.txt:1", "'zero'"});
  folder_.write("rgb.txt", "5.0 rgb/0.jpg\n");
  expectOpenFails(ErrorCode::kInput, {"rgb.txt", "no colour image has a depth image", "4.899"});
  folder_.write("rgb.txt", "0.0 rgb/0.jpg\n");
  fs::remove(path_ / "depth.txt");
  expectOpenFails(ErrorCode::kInput, {"no depth.txt"});
}

TEST_F(TumFolder, ImagesThatAreWrongNameFileAndLine) {
  test::writeTumRecording(path_, 6);
  fs::remove(path_ / "rgb/0.jpg");
  test::truncateFile(path_ / "rgb/1.jpg", 0.7);
  test::truncateFile(path_ / "depth/2.png", 0.7);
  cv::imwrite((path_ / "rgb/3.jpg").string(), cv::Mat(24, 32, CV_8UC3, cv::Scalar(1, 2, 3)));
  cv::imwrite((path_ / "depth/4.png").string(), cv::Mat(24, 32, CV_16UC1, cv::Scalar(9)));
  cv::imwrite((path_ / "depth/5.png").string(), cv::Mat(48, 64, CV_8UC1, cv::Scalar(9)));
  expectReadFails(0, {"rgb/0.jpg", "cannot open", "rgb.txt:2"});
  expectReadFails(1, {"rgb/1.jpg", "truncated", "rgb.txt:3"});
  expectReadFails(2, {"depth/2.png", "truncated", "rgb.txt:4"});
  expectReadFails(3, {"rgb/3.jpg", "32x24", "64x48", "rgb.txt:5"});
  expectReadFails(4, {"depth/4.png", "32x24", "64x48", "[depth]"});
  expectReadFails(5, {"depth/5.png", "8-bit depth"});
}

TEST_F(TumFolder, Intrinsics) {
  test::writeTumRecording(path_, 1);
  fs::rename(path_ / "camera.toml", path_ / "other.toml");
  expectOpenFails(ErrorCode::kInput, {"camera.toml", "no intrinsics", "--camera", "tum-fr1"});
  EXPECT_EQ(openRecording(path_, {(path_ / "other.toml").string(), 0.02})->camera().fx, 50.0);
  EXPECT_EQ(openRecording(path_, {"tum-fr2", 0.02})->camera().fx, 520.9);
  expectError(ErrorCode::kUsage, {"tum-fr7"}, [&] { (void)openRecording(path_, {"tum-fr7", 0.02}); });
  expectError(ErrorCode::kUsage, {"max_association_s"}, [&] { (void)openRecording(path_, {"tum-fr1", -1.0}); });
}

TEST_F(TumFolder, MountStartAndOdometry) {
  test::writeTumRecording(path_, 1);
  EXPECT_FALSE(openRecording(path_)->findOdometry().has_value());
  EXPECT_FALSE(openRecording(path_)->T_base_camera().has_value());
  EXPECT_FALSE(openRecording(path_)->startNs().has_value());
  test::append(path_ / "camera.toml", "start = 1970-01-01T00:00:01Z\nT_base_camera = [0.1, 0, 1.2, -0.5, 0.5, -0.5, 0.5]\n");
  folder_.write("odometry.txt", "0.0 1 2 3 0 0 0 1\n");
  const auto recording = openRecording(path_);
  EXPECT_EQ(recording->startNs(), 1000000000);
  EXPECT_EQ(recording->T_base_camera()->translation().z(), 1.2);
  EXPECT_EQ(recording->findOdometry()->front().T_map_camera.translation().y(), 2.0);
  folder_.write("odometry.txt", "0.0 1 2 3 0 0 0 2\n");
  expectError(ErrorCode::kInput, {"odometry.txt:1"}, [&] { (void)recording->findOdometry(); });
}

TEST_F(SevenScenesFolder, NumbersBecomeStamps) {
  folder_.write("camera.toml", test::kTinyCamera);
  for (const int number : {7, 3, 12}) {
    const std::string name = "frame-00000" + std::to_string(number);
    cv::imwrite((path_ / (name + ".color.png")).string(), test::tinyColor(number));
    cv::imwrite((path_ / (name + ".depth.png")).string(), test::tinyDepth(1000 + number));
  }
  cv::imwrite((path_ / "frame-000020.color.jpg").string(), test::tinyColor(20));
  cv::imwrite((path_ / "frame-000021.depth.png").string(), test::tinyDepth(21));
  cv::imwrite((path_ / "frame-000003.color.jpg").string(), test::tinyColor(3));
  folder_.write("frame-000030.pose.txt", "");
  const auto recording = openRecording(path_);
  ASSERT_EQ(recording->frameCount(), 3);
  EXPECT_EQ(recording->stampNs(0), 100000000);
  EXPECT_EQ(recording->stampNs(1), 233333333);
  EXPECT_EQ(recording->stampNs(2), 400000000);
  EXPECT_FLOAT_EQ(recording->read(2, Channels::kGray).depth_m.at<float>(0, 0), 1.012F);
  const ListingStatistics statistics = recording->listing();
  EXPECT_EQ(statistics.unmatched_color, 1);
  EXPECT_EQ(statistics.unmatched_depth, 1);
  EXPECT_EQ(statistics.duplicate_color, 1);
  EXPECT_EQ(statistics.listed_color, 5);
  test::append(path_ / "camera.toml", "rate_hz = 10\n");
  EXPECT_EQ(openRecording(path_)->stampNs(1), 700000000);
}

TEST_F(SevenScenesFolder, NoPairs) {
  folder_.write("camera.toml", test::kTinyCamera);
  cv::imwrite((path_ / "frame-000000.color.jpg").string(), test::tinyColor(0));
  expectOpenFails(ErrorCode::kInput, {"no frame has both"});
}

TEST_F(RecordingFolder, UnknownContent) {
  expectOpenFails(ErrorCode::kInput, {"not a recording", "rgb.txt", "frame-000000.color"});
  expectError(ErrorCode::kIo, {"no such folder"}, [&] { (void)openRecording(path_ / "absent"); });
  folder_.write("file", "x");
  expectError(ErrorCode::kInput, {"not a folder"}, [&] { (void)openRecording(path_ / "file"); });
}

}  // namespace
}  // namespace oikos::recording
