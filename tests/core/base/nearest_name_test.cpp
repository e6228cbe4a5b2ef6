// SPDX-License-Identifier: Apache-2.0
#include "core/base/nearest_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace oikos::base {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(editDistance("", ""), 0);
  EXPECT_EQ(editDistance("", "abc"), 3);
  EXPECT_EQ(editDistance("abc", ""), 3);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);
  EXPECT_EQ(editDistance("flaw", "lawn"), 2);
}

TEST(NearestName, IsTheFirstOfEquals) {
  const std::vector<std::string> names = {"map", "mop", "inspect"};
  EXPECT_EQ(nearestName("mip", names), "map");
  EXPECT_EQ(nearestName("inspekt", names), "inspect");
  EXPECT_EQ(nearestName("x", std::vector<std::string>{}), "");
}

TEST(DidYouMean, ListsAllWhenNothingIsNear) {
  const std::vector<std::string> names = {"map", "inspect"};
  EXPECT_EQ(didYouMean("inspct", names), "; did you mean 'inspect'?");
  EXPECT_EQ(didYouMean("zzzzz", names), "; known: map, inspect");
  EXPECT_EQ(didYouMean("zzzzz", std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace oikos::base
