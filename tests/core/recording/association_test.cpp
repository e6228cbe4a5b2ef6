// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>

#include "core/recording/listing.h"

namespace oikos::recording {
namespace {

std::vector<ListedImage> images(const std::vector<std::int64_t>& stamps_ns) {
  std::vector<ListedImage> list;
  for (const std::int64_t stamp_ns : stamps_ns) {
    list.push_back({stamp_ns, {}, {}});
  }
  return list;
}

std::vector<std::pair<int, int>> pairsOf(const std::vector<std::int64_t>& color, const std::vector<std::int64_t>& depth,
                                         std::int64_t limit) {
  std::vector<std::pair<int, int>> pairs;
  for (const ImagePair& pair : associate(images(color), images(depth), limit)) {
    pairs.emplace_back(pair.color, pair.depth);
  }
  return pairs;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(Associate, TheClosestPairGoesFirst) {
  // colour 0 could have depth 0 (9 away), but colour 1 is nearer to it (1 away) and colour 0 is left with nothing
  EXPECT_EQ(pairsOf({100, 110}, {109, 300}, 20), (Pairs{{1, 0}}));
  EXPECT_EQ(pairsOf({100, 110}, {109, 115}, 20), (Pairs{{0, 1}, {1, 0}}));
}

TEST(Associate, LimitIsIncluded) {
  EXPECT_EQ(pairsOf({100}, {120}, 20), (Pairs{{0, 0}}));
  EXPECT_EQ(pairsOf({100}, {121}, 20), Pairs{});
  EXPECT_EQ(pairsOf({100}, {80}, 20), (Pairs{{0, 0}}));
}

TEST(Associate, TiesGoToTheEarlier) {
  EXPECT_EQ(pairsOf({100}, {95, 105}, 20), (Pairs{{0, 0}}));
}

TEST(Associate, EachImageOnceAndEmptyLists) {
  EXPECT_EQ(pairsOf({100, 101, 102}, {101}, 20), (Pairs{{1, 0}}));
  EXPECT_EQ(pairsOf({}, {1, 2}, 20), Pairs{});
  EXPECT_EQ(pairsOf({1, 2}, {}, 20), Pairs{});
}

}  // namespace
}  // namespace oikos::recording
