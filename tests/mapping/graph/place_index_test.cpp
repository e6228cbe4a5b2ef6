// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/place_index.h"

#include <gtest/gtest.h>

#include <random>

namespace oikos::mapping {
namespace {

Features randomImage(std::mt19937_64& random, int count) {
  Features features;
  for (int i = 0; i < count; ++i) {
    features.pixel.emplace_back(i, i);
    features.point_camera.emplace_back(0.0, 0.0, 1.0);
    features.descriptor.push_back({random(), random(), random(), random()});
  }
  return features;
}

/// The same things seen again: each descriptor with some of its 256 bits turned over.
Features seenAgain(const Features& features, int flipped_bits, std::mt19937_64& random) {
  Features again = features;
  std::uniform_int_distribution<std::size_t> anyBit(0, 255);
  for (Descriptor& d : again.descriptor) {
    for (int i = 0; i < flipped_bits; ++i) {
      const std::size_t bit = anyBit(random);
      d[bit / 64] ^= std::uint64_t{1} << (bit % 64);
    }
  }
  return again;
}

struct World {
  std::vector<Features> images;
  PlaceIndex index;

  World(int count, int features_per_image, std::mt19937_64& random) {
    for (int place = 0; place < count; ++place) {
      images.push_back(randomImage(random, features_per_image));
      index.add(place, images.back());
    }
  }
};

TEST(PlaceIndex, FindsThePlaceAmongAThousand) {
  std::mt19937_64 random(1);
  const World world(1000, 100, random);
  for (int place = 0; place < 1000; place += 7) {
    const Features query = seenAgain(world.images[static_cast<std::size_t>(place)], 12, random);
    const auto found = world.index.query(query, 4);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].place, place);
    EXPECT_GE(found[0].votes, 30);
    EXPECT_TRUE(found.size() == 1 || found[1].votes < 10);
  }
}

TEST(PlaceIndex, AnUnknownPlaceHasHardlyAVote) {
  std::mt19937_64 random(2);
  const World world(300, 100, random);
  for (const PlaceIndex::Candidate& c : world.index.query(randomImage(random, 100), 10)) {
    EXPECT_LE(c.votes, 2);
  }
}

TEST(PlaceIndex, AnEmptyIndexAndAnEmptyQueryFindNothing) {
  std::mt19937_64 random(3);
  EXPECT_TRUE(PlaceIndex().query(randomImage(random, 50), 5).empty());
  const World world(3, 20, random);
  EXPECT_TRUE(world.index.query(Features{}, 5).empty());
}

TEST(PlaceIndex, MostVotesComeFirstAndEqualOnesByNumber) {
  std::mt19937_64 random(4);
  const Features whole = randomImage(random, 20);
  Features half = whole;
  half.descriptor.resize(10);
  PlaceIndex index;
  index.add(9, half);
  index.add(5, whole);
  index.add(2, half);
  const auto found = index.query(whole, 3);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].place, 5);
  EXPECT_EQ(found[0].votes, 20);
  EXPECT_EQ(found[1].place, 2);
  EXPECT_EQ(found[1].votes, 10);
  EXPECT_EQ(found[2].place, 9);
  EXPECT_EQ(index.query(whole, 2).size(), 2U);
}

TEST(PlaceIndex, AFeatureVotesOnceForAPlace) {
  std::mt19937_64 random(5);
  Features repeated = randomImage(random, 1);
  for (int i = 0; i < 10; ++i) {
    repeated.descriptor.push_back(repeated.descriptor[0]);  // a patterned wall
  }
  PlaceIndex index;
  index.add(0, repeated);
  Features one = repeated;
  one.descriptor.resize(1);
  const auto found = index.query(one, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].votes, 1);
}

/// As many times the drive, about as much work a query.
TEST(PlaceIndex, AQueryDoesNotGrowWithTheDrive) {
  std::mt19937_64 random(6);
  const Features query = randomImage(random, 200);
  const World small(50, 100, random);
  const World large(1600, 100, random);
  const auto cost = [&](const World& world) { return static_cast<double>(world.index.comparisons(query)) / query.size(); };
  EXPECT_GT(cost(small), 1.0);
  EXPECT_LE(cost(large), 60.0);               // a full leaf
  EXPECT_LT(cost(large), 2.0 * cost(small));  // of 32 times the entries
}

/// A thousand copies of one thing cannot be told apart by any bit; they must not be lost, nor split for ever.
TEST(PlaceIndex, IdenticalDescriptorsShareALeaf) {
  std::mt19937_64 random(7);
  const Features same = randomImage(random, 1);
  PlaceIndex index;
  for (int place = 0; place < 1000; ++place) {
    index.add(place, same);
  }
  EXPECT_EQ(index.query(same, 2000).size(), 1000U);
}

}  // namespace
}  // namespace oikos::mapping
