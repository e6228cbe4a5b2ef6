// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/brick_index.h"

#include <algorithm>
#include <numeric>

namespace oikos::mapping {

std::vector<std::uint32_t> BrickIndex::sorted() const {
  std::vector<std::uint32_t> numbers(keys_.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::sort(numbers.begin(), numbers.end(), [this](std::uint32_t a, std::uint32_t b) { return keys_[a] < keys_[b]; });
  return numbers;
}

void BrickIndex::clear() {
  keys_.clear();
  std::fill(slots_.begin(), slots_.end(), 0U);
}

void BrickIndex::grow() {
  slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), 0U);
  mask_ = slots_.size() - 1;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    std::size_t slot = home(keys_[i]);
    while (slots_[slot] != 0) {
      slot = (slot + 1) & mask_;
    }
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

}  // namespace oikos::mapping
