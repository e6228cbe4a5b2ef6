// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "mapping/volume/brick_index.h"
#include "mapping/volume/voxel_key.h"

namespace oikos::mapping {

/// A set of voxels as bits in bricks. Not thread-safe.
class VoxelSet {
 public:
  using Bits = std::array<std::uint64_t, kBrickVoxels / 64>;

  /// The bits of a brick, made empty if it is new; valid until the next call.
  Bits& bits(VoxelKey brick) { return bits_[number(brick)]; }

  /// The brick's number, which stays its own; made empty if it is new.
  std::uint32_t number(VoxelKey brick) {
    const std::uint32_t number = index_.findOrInsert(brick);
    if (number == bits_.size()) {
      bits_.emplace_back();
    }
    return number;
  }
  void setBit(std::uint32_t number, unsigned place) { bits_[number][place / 64] |= std::uint64_t{1} << (place % 64); }

  void insert(VoxelKey key) {
    if (brickOf(key) != latest_brick_) {
      latest_brick_ = brickOf(key);
      latest_number_ = number(latest_brick_);
    }
    setBit(latest_number_, placeInBrick(key));
  }

  [[nodiscard]] const Bits* find(VoxelKey brick) const {
    const auto number = index_.find(brick);
    return number ? &bits_[*number] : nullptr;
  }

  void merge(const VoxelSet& other) {
    for (std::uint32_t i = 0; i < other.index_.size(); ++i) {
      Bits& mine = bits(other.index_.key(i));
      for (std::size_t word = 0; word < mine.size(); ++word) {
        mine[word] |= other.bits_[i][word];
      }
    }
  }

  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (std::uint32_t i = 0; i < index_.size(); ++i) {
      for (unsigned word = 0; word < bits_[i].size(); ++word) {
        for (std::uint64_t rest = bits_[i][word]; rest != 0; rest &= rest - 1) {
          visit(index_.key(i) | offsetOfPlace(word * 64 + static_cast<unsigned>(std::countr_zero(rest))));
        }
      }
    }
  }

  [[nodiscard]] std::size_t brickCount() const { return index_.size(); }
  [[nodiscard]] VoxelKey brick(std::size_t number) const { return index_.key(static_cast<std::uint32_t>(number)); }
  [[nodiscard]] const Bits& bitsOf(std::size_t number) const { return bits_[number]; }

  void clear() {
    index_.clear();
    bits_.clear();
    latest_brick_ = ~VoxelKey{0};
  }

 private:
  BrickIndex index_;
  std::vector<Bits> bits_;
  VoxelKey latest_brick_ = ~VoxelKey{0};  ///< of `insert`: neighbouring points mostly share a brick
  std::uint32_t latest_number_ = 0;
};

}  // namespace oikos::mapping
