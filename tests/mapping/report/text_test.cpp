// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace oikos::mapping {
namespace {

TEST(ReportText, GroupsThousands) {
  EXPECT_EQ(countText(0), "0");
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(1000), "1\u202F000");
  EXPECT_EQ(countText(1234567), "1\u202F234\u202F567");
  EXPECT_EQ(countText(-1234), "-1\u202F234");
}

TEST(ReportText, NumbersHaveNoNegativeZeroAndNoNan) {
  EXPECT_EQ(numberText(1.005, 1), "1.0");
  EXPECT_EQ(numberText(-0.001, 2), "0.00");
  EXPECT_EQ(numberText(-0.01, 2), "-0.01");
  EXPECT_EQ(numberText(std::numeric_limits<double>::quiet_NaN(), 2), "–");
  EXPECT_EQ(numberText(std::numeric_limits<double>::infinity(), 2), "–");
}

TEST(ReportText, LengthsInTheUnitThatFits) {
  EXPECT_EQ(lengthText(0.0), "0.0 cm");
  EXPECT_EQ(lengthText(0.0082), "0.8 cm");
  EXPECT_EQ(lengthText(0.0996), "10 cm");
  EXPECT_EQ(lengthText(0.29), "29 cm");
  EXPECT_EQ(lengthText(1.234), "1.23 m");
}

TEST(ReportText, SharesAreNeverRoundedToNoneOrAll) {
  EXPECT_EQ(shareText(0, 600), "0 %");
  EXPECT_EQ(shareText(600, 600), "100 %");
  EXPECT_EQ(shareText(1, 100000), "0.1 %");
  EXPECT_EQ(shareText(99999, 100000), "99.9 %");
  EXPECT_EQ(shareText(1, 4), "25.0 %");
  EXPECT_EQ(shareText(0, 0), "–");
}

TEST(ReportText, CountsWithTheirNoun) {
  EXPECT_EQ(countedText(1, "loop", "loops"), "1 loop");
  EXPECT_EQ(countedText(0, "loop", "loops"), "0 loops");
}

}  // namespace
}  // namespace oikos::mapping
