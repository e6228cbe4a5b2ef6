// SPDX-License-Identifier: Apache-2.0
#include "core/recording/decimal.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace oikos::recording {
namespace {

TEST(Decimal, StampsKeepEveryNanosecond) {
  EXPECT_EQ(parseStampNs("1305031229.528748"), 1305031229528748000);
  EXPECT_EQ(parseStampNs("1305031229.528748123"), 1305031229528748123);
  EXPECT_EQ(parseStampNs("1.305031229528748e+09"), 1305031229528748000);
  EXPECT_EQ(parseStampNs("0"), 0);
  EXPECT_EQ(parseStampNs(".5"), 500000000);
  EXPECT_EQ(parseStampNs("5."), 5000000000);
  EXPECT_EQ(parseStampNs("-0.25"), -250000000);
  EXPECT_EQ(parseStampNs("+3"), 3000000000);
  EXPECT_EQ(parseStampNs("0.0000000004"), 0);
  EXPECT_EQ(parseStampNs("0.0000000005"), 1);
  EXPECT_EQ(parseStampNs("0.9999999999"), 1000000000);
  EXPECT_EQ(parseStampNs("1e-20"), 0);
}

TEST(Decimal, StampsRejectEverythingElse) {
  for (const char* text : {"", "-", ".", "abc", "1.2.3", "1,5", "nan", "inf", "1e", "1e999", "0x10", "1 ", "99999999999", "--1"}) {
    EXPECT_FALSE(parseStampNs(text).has_value()) << text;
  }
}

TEST(Decimal, StampsSurviveTheRoundTrip) {
  for (const std::int64_t stamp_ns : {std::int64_t{0}, std::int64_t{33333333}, std::int64_t{1305031229528748000},
                                      std::int64_t{1305031229528748123}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min() + 2}) {
    EXPECT_EQ(parseStampNs(formatStamp(stamp_ns)), stamp_ns) << formatStamp(stamp_ns);
  }
  EXPECT_EQ(formatStamp(1305031229528748000), "1305031229.528748");
  EXPECT_EQ(formatStamp(33333333), "0.033333333");
  EXPECT_EQ(formatStamp(-250000000), "-0.250000");
}

TEST(Decimal, Numbers) {
  EXPECT_EQ(parseNumber("-1.5e-3"), -0.0015);
  EXPECT_EQ(parseNumber("+2"), 2.0);
  for (const char* text : {"", "1,5", "nan", "inf", "-inf", "1e400", "1.5x", "+-1"}) {
    EXPECT_FALSE(parseNumber(text).has_value()) << text;
  }
}

TEST(Decimal, ValuesHaveNineDigitsAndNoMinusZero) {
  EXPECT_EQ(formatValue(1.0 / 3.0), "0.333333333");
  EXPECT_EQ(formatValue(-1e-12), "0.000000000");
  EXPECT_EQ(formatValue(-12.5), "-12.500000000");
}

TEST(Decimal, Fields) {
  EXPECT_EQ(splitFields(" a\tb  c\r"), (std::vector<std::string_view>{"a", "b", "c"}));
  EXPECT_TRUE(splitFields("  # a b").empty());
  EXPECT_TRUE(splitFields(" \r").empty());
}

}  // namespace
}  // namespace oikos::recording
