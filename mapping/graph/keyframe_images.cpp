// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_images.h"

#include <algorithm>

namespace oikos::mapping {

KeyframeImages::KeyframeImages(Loader loader, int pyramid_levels, int capacity)
    : loader_(std::move(loader)), pyramid_levels_(pyramid_levels), capacity_(static_cast<std::size_t>(capacity)) {}

void KeyframeImages::put(int frame, std::shared_ptr<const ImagePyramid> pyramid) {
  const std::lock_guard lock(mutex_);
  entries_[frame] = {std::move(pyramid), ++uses_};
  evict();
}

std::shared_ptr<const ImagePyramid> KeyframeImages::get(int frame) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = entries_.find(frame); found != entries_.end()) {
      found->second.last_use = ++uses_;
      return found->second.pyramid;
    }
  }
  auto pyramid = std::make_shared<const ImagePyramid>(loader_(frame), pyramid_levels_);
  put(frame, pyramid);
  return pyramid;
}

void KeyframeImages::clear() {
  const std::lock_guard lock(mutex_);
  entries_.clear();
}

void KeyframeImages::evict() {
  while (entries_.size() > capacity_) {
    const auto oldest = std::min_element(entries_.begin(), entries_.end(),
                                         [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; });
    entries_.erase(oldest);
  }
}

}  // namespace oikos::mapping
