// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace oikos::mapping {

/// Numbers distinct 64-bit keys 0, 1, 2 … in the order in which they first come: the index over bricks that lie in an array
/// beside it. An open-addressing hash table. Not thread-safe, except for concurrent `find`.
class BrickIndex {
 public:
  [[nodiscard]] std::optional<std::uint32_t> find(std::uint64_t key) const {
    if (slots_.empty()) {
      return std::nullopt;
    }
    for (std::size_t slot = home(key);; slot = (slot + 1) & mask_) {
      const std::uint32_t number = slots_[slot];
      if (number == 0) {
        return std::nullopt;
      }
      if (keys_[number - 1] == key) {
        return number - 1;
      }
    }
  }

  /// The key's number; a key not seen before gets number size().
  std::uint32_t findOrInsert(std::uint64_t key) {
    if (2 * (keys_.size() + 1) > slots_.size()) {
      grow();
    }
    for (std::size_t slot = home(key);; slot = (slot + 1) & mask_) {
      const std::uint32_t number = slots_[slot];
      if (number == 0) {
        keys_.push_back(key);
        slots_[slot] = static_cast<std::uint32_t>(keys_.size());
        return slots_[slot] - 1;
      }
      if (keys_[number - 1] == key) {
        return number - 1;
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] std::uint64_t key(std::uint32_t number) const { return keys_[number]; }
  [[nodiscard]] std::size_t memoryBytes() const { return slots_.capacity() * sizeof(slots_[0]) + keys_.capacity() * sizeof(keys_[0]); }

  /// Numbers in ascending order of their keys: an order that does not depend on who came first.
  [[nodiscard]] std::vector<std::uint32_t> sorted() const;

  /// Forgets the keys, keeps the memory.
  void clear();

 private:
  [[nodiscard]] std::size_t home(std::uint64_t key) const { return ((key * 0x9E3779B97F4A7C15ULL) >> 20U) & mask_; }
  void grow();

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> slots_;  ///< number + 1; 0 = free
  std::size_t mask_ = 0;
};

}  // namespace oikos::mapping
