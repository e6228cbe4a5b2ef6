// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <thread>

namespace oikos::simulate {

/// A frame's two images and the files they go to.
struct FrameFiles {
  std::filesystem::path color_file;
  std::filesystem::path depth_file;
  cv::Mat color;  ///< CV_8UC3; not changed any more by its maker
  cv::Mat depth;  ///< CV_16UC1; the same
};

/// As JPEG of this quality; 0: as PNG. Throws Error{kIo}.
void writeImage(const std::filesystem::path& file, const cv::Mat& image, int jpeg_quality);

/// Compresses and writes frames while the next ones are made, a few at most behind. To be used by one thread.
class FrameWriter {
 public:
  /// `jpeg_quality` of the colour images; 0: PNG. With one thread, frames are written within write().
  FrameWriter(int jpeg_quality, int threads);
  /// What is waiting is dropped unless finish() was called.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Throws Error{kIo} if this frame or one before it could not be written.
  void write(FrameFiles frame);
  /// Waits for the last frame. Throws as write().
  void finish();

 private:
  void work();
  void compress(const FrameFiles& frame) const;
  void rethrow();

  int jpeg_quality_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FrameFiles> waiting_;  ///< the first one is being written
  bool is_ending_ = false;
  std::exception_ptr failure_;
  std::thread worker_;  ///< none with one thread
};

}  // namespace oikos::simulate
