// SPDX-License-Identifier: Apache-2.0
#include "core/recording/frame_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>

#include "tests/support/expect_error.h"

namespace oikos::recording {
namespace {

using base::ErrorCode;
using test::expectError;

/// A recording without files: the grey value of frame i is i.
class CountingRecording : public Recording {
 public:
  explicit CountingRecording(int frames, std::set<int> unreadable = {}) : frames_(frames), unreadable_(std::move(unreadable)) {}

  [[nodiscard]] const camera::PinholeCamera& camera() const override { return camera_; }
  [[nodiscard]] int frameCount() const override { return frames_; }
  [[nodiscard]] std::int64_t stampNs(int index) const override { return index * 1000; }
  [[nodiscard]] camera::RgbdFrame read(int index, Channels /*channels*/) const override {
    reads_++;
    if (index == broken_contract_at) {
      throw std::logic_error("a bug");
    }
    if (unreadable_.contains(index)) {
      throw base::Error(ErrorCode::kInput, "truncated", "frame " + std::to_string(index));
    }
    camera::RgbdFrame frame;
    frame.index = index;
    frame.stamp_ns = stampNs(index);
    frame.gray = cv::Mat(1, 1, CV_8UC1, cv::Scalar(index % 256));
    return frame;
  }
  [[nodiscard]] int reads() const { return reads_; }
  int broken_contract_at = -1;

 private:
  camera::PinholeCamera camera_;
  int frames_;
  std::set<int> unreadable_;
  mutable std::atomic<int> reads_ = 0;
};

std::vector<int> drain(FrameStream& stream) {
  std::vector<int> indices;
  while (const auto frame = stream.next()) {
    EXPECT_EQ(frame->gray.at<uchar>(0, 0), frame->index % 256);
    indices.push_back(frame->index);
  }
  return indices;
}

FrameStreamConfig configWith(int capacity, int threads, int stride) {
  FrameStreamConfig config;
  config.capacity = capacity;
  config.decode_threads = threads;
  config.stride = stride;
  return config;
}

TEST(FrameStream, KeepsTheOrderForAnyNumberOfThreads) {
  const CountingRecording recording(100, {5, 50});
  std::vector<int> expected;
  for (int i = 0; i < 100; ++i) {
    if (i != 5 && i != 50) {
      expected.push_back(i);
    }
  }
  for (const int threads : {1, 2, 5}) {
    for (const int capacity : {1, 3, 200}) {
      FrameStream stream(recording, configWith(capacity, threads, 1));
      EXPECT_EQ(drain(stream), expected) << threads << " threads, capacity " << capacity;
      EXPECT_EQ(stream.statistics().listed, 100);
      EXPECT_EQ(stream.statistics().read, 98);
      EXPECT_EQ(stream.statistics().unreadable, 2);
      ASSERT_EQ(stream.statistics().first_messages.size(), 2U);
      EXPECT_EQ(stream.statistics().first_messages[0], "frame 5: truncated");
      EXPECT_FALSE(stream.next().has_value());
    }
  }
}

TEST(FrameStream, Stride) {
  const CountingRecording recording(20);
  FrameStream stream(recording, configWith(2, 1, 6));
  EXPECT_EQ(drain(stream), (std::vector<int>{0, 6, 12, 18}));
  EXPECT_EQ(stream.statistics().listed, 4);
}

TEST(FrameStream, ATwentiethIsToleratedAQuarterIsNot) {
  const CountingRecording tolerated(10, {0, 9});
  FrameStream stream(tolerated);
  EXPECT_EQ(drain(stream).size(), 8U);
  const CountingRecording too_many(10, {1, 4, 7});
  FrameStream failing(too_many);
  std::vector<int> before;
  expectError(ErrorCode::kInput, {"3 of the 10 frames", "frame 1: truncated"}, [&] {
    while (const auto frame = failing.next()) {
      before.push_back(frame->index);
    }
  });
  EXPECT_EQ(before, (std::vector<int>{0, 2, 3, 5, 6}));
}

TEST(FrameStream, BugsAreNotTakenForBadFiles) {
  CountingRecording recording(5);
  recording.broken_contract_at = 2;
  FrameStream stream(recording);
  EXPECT_EQ(stream.next()->index, 0);
  EXPECT_EQ(stream.next()->index, 1);
  EXPECT_THROW((void)stream.next(), std::logic_error);
}

TEST(FrameStream, AheadByItsCapacityAndNoFarther) {
  const CountingRecording recording(1000);
  {
    FrameStream stream(recording, configWith(4, 3, 1));
    EXPECT_EQ(stream.next()->index, 0);
  }  // not drained: the destructor must come back
  EXPECT_LE(recording.reads(), 5);
  { const FrameStream never_used(recording, configWith(4, 3, 1)); }
  EXPECT_LE(recording.reads(), 9);
}

TEST(FrameStream, EmptyRecording) {
  const CountingRecording recording(0);
  FrameStream stream(recording);
  EXPECT_FALSE(stream.next().has_value());
}

TEST(FrameStream, WrongConfiguration) {
  const CountingRecording recording(3);
  expectError(ErrorCode::kUsage, {"stride = 0"}, [&] { const FrameStream stream(recording, configWith(1, 1, 0)); });
  expectError(ErrorCode::kUsage, {"capacity = 0"}, [&] { const FrameStream stream(recording, configWith(0, 1, 1)); });
  expectError(ErrorCode::kUsage, {"decode_threads = 0"}, [&] { const FrameStream stream(recording, configWith(1, 0, 1)); });
  FrameStreamConfig config;
  config.max_unreadable_share = 1.5;
  expectError(ErrorCode::kUsage, {"max_unreadable_share"}, [&] { const FrameStream stream(recording, config); });
}

}  // namespace
}  // namespace oikos::recording
