// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/brick_index.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "mapping/volume/voxel_key.h"

namespace oikos::mapping {
namespace {

TEST(BrickIndex, NumbersKeysLikeAMap) {
  std::mt19937_64 random(1);
  std::map<std::uint64_t, std::uint32_t> expected;
  BrickIndex index;
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t key = random() % 5000;
    const auto next = static_cast<std::uint32_t>(expected.size());
    EXPECT_EQ(index.findOrInsert(key), expected.try_emplace(key, next).first->second);
  }
  EXPECT_EQ(index.size(), expected.size());
  EXPECT_FALSE(index.find(5001).has_value());
  const auto sorted = index.sorted();
  ASSERT_EQ(sorted.size(), expected.size());
  std::size_t place = 0;
  for (const auto& [key, number] : expected) {
    EXPECT_EQ(index.find(key), number);
    EXPECT_EQ(sorted[place++], number);
  }
  index.clear();
  EXPECT_EQ(index.size(), 0U);
  EXPECT_FALSE(index.find(expected.begin()->first).has_value());
  EXPECT_EQ(index.findOrInsert(7), 0U);
}

TEST(BrickIndex, AnEmptyOneHoldsNothing) {
  EXPECT_FALSE(BrickIndex().find(0).has_value());
}

TEST(VoxelKey, PlacesInABrickAreDistinctAndComeBack) {
  std::array<bool, kBrickVoxels> seen{};
  for (std::uint16_t x = 0; x < 8; ++x) {
    for (std::uint16_t y = 0; y < 8; ++y) {
      for (std::uint16_t z = 0; z < 8; ++z) {
        const VoxelKey key = packVoxelKey(x, y, z);
        const unsigned place = placeInBrick(key);
        ASSERT_LT(place, seen.size());
        EXPECT_FALSE(seen[place]);
        seen[place] = true;
        EXPECT_EQ(offsetOfPlace(place), key);
        EXPECT_EQ(unpackVoxelKey(key), (std::array<std::uint16_t, 3>{x, y, z}));
      }
    }
  }
}

}  // namespace
}  // namespace oikos::mapping
