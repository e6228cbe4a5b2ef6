// SPDX-License-Identifier: Apache-2.0
#include "core/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace oikos::base {
namespace {

TEST(NumberText, IsShortestThatReadsBack) {
  EXPECT_EQ(toText(0.1), "0.1");
  EXPECT_EQ(toText(1.0), "1");
  EXPECT_EQ(toText(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(toText(1e-9), "1e-09");
  EXPECT_EQ(toText(std::int64_t{-42}), "-42");
  for (const double number : {std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), -1.0 / 3.0}) {
    EXPECT_EQ(findNumber(toText(number)), number);
  }
}

TEST(NumberText, FixedRoundsToNearest) {
  EXPECT_EQ(toFixedText(1.25, 1), "1.2");
  EXPECT_EQ(toFixedText(1.26, 1), "1.3");
  EXPECT_EQ(toFixedText(-0.5, 3), "-0.500");
  EXPECT_EQ(toFixedText(std::numeric_limits<double>::max(), 0).size(), 309U);
  EXPECT_THROW(toFixedText(1.0, 1000), ContractViolation);
}

TEST(NumberText, NumberHasNothingAroundIt) {
  EXPECT_EQ(findNumber("2.5"), 2.5);
  EXPECT_TRUE(std::isnan(*findNumber("nan")));
  for (const char* text : {"", "2,5", "2.5 ", " 2.5", "2.5m", "--2"}) {
    EXPECT_FALSE(findNumber(text)) << text;
  }
}

}  // namespace
}  // namespace oikos::base
