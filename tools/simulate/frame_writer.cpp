// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/frame_writer.h"

#include <fstream>
#include <utility>
#include <vector>

#include "core/base/posix_file.h"
#include "core/recording/image_codec.h"
#include "core/recording/png_encoder.h"

namespace oikos::simulate {

namespace {

constexpr std::size_t kMostWaiting = 3;
constexpr int kFastPng = 1;

}  // namespace

void writeImage(const std::filesystem::path& file, const cv::Mat& image, int jpeg_quality) {
  const std::vector<unsigned char> bytes =
      jpeg_quality > 0 ? recording::encodeJpeg(image, jpeg_quality) : recording::encodePng(image, kFastPng);
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) {
    base::throwErrno("cannot write", file);
  }
}

FrameWriter::FrameWriter(int jpeg_quality, int threads) : jpeg_quality_(jpeg_quality) {
  if (threads > 1) {
    worker_ = std::thread([this] { work(); });
  }
}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) {
    worker_.join();
  }
}

void FrameWriter::write(FrameFiles frame) {
  if (!worker_.joinable()) {
    compress(frame);
    return;
  }
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_.size() < kMostWaiting || failure_; });
    rethrow();
    waiting_.push_back(std::move(frame));
  }
  changed_.notify_all();
}

void FrameWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty() || failure_; });
  rethrow();
}

void FrameWriter::rethrow() {
  if (failure_) {
    std::rethrow_exception(failure_);
  }
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return is_ending_ || !waiting_.empty(); });
    if (is_ending_) {
      return;
    }
    const FrameFiles& frame = waiting_.front();  // stays where it is while others are added behind it
    lock.unlock();
    std::exception_ptr failure;
    try {
      compress(frame);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) {
      failure_ = failure;
      changed_.notify_all();
      return;
    }
    waiting_.pop_front();
    changed_.notify_all();
  }
}

void FrameWriter::compress(const FrameFiles& frame) const {
  writeImage(frame.color_file, frame.color, jpeg_quality_);
  writeImage(frame.depth_file, frame.depth, 0);
}

}  // namespace oikos::simulate
