// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "mapping/odometry/image_pyramid.h"

namespace oikos::mapping {

/// The grey pyramids of frames, the most recently used ones in memory, the others read again from the recording when they are
/// asked for: memory does not grow with the drive. Thread-safe.
class KeyframeImages {
 public:
  using Loader = std::function<cv::Mat(int frame)>;  ///< the grey image (CV_8UC1) of a frame of the recording

  KeyframeImages(Loader loader, int pyramid_levels, int capacity);

  void put(int frame, std::shared_ptr<const ImagePyramid> pyramid);
  [[nodiscard]] std::shared_ptr<const ImagePyramid> get(int frame);
  void clear();

 private:
  struct Entry {
    std::shared_ptr<const ImagePyramid> pyramid;
    std::uint64_t last_use = 0;
  };
  void evict();

  Loader loader_;
  int pyramid_levels_;
  std::size_t capacity_;
  std::mutex mutex_;
  std::uint64_t uses_ = 0;
  std::map<int, Entry> entries_;
};

}  // namespace oikos::mapping
