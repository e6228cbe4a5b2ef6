// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/error_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oikos::metrics {
namespace {

TEST(ErrorStatistics, OfAnOddNumber) {
  const ErrorStatistics statistics = statisticsOf({3.0, 1.0, 8.0});
  EXPECT_EQ(statistics.count, 3);
  EXPECT_DOUBLE_EQ(statistics.mean, 4.0);
  EXPECT_DOUBLE_EQ(statistics.median, 3.0);
  EXPECT_DOUBLE_EQ(statistics.max, 8.0);
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt(74.0 / 3.0));
}

TEST(ErrorStatistics, MedianOfAnEvenNumberIsTheMeanOfTheMiddleTwo) {
  EXPECT_DOUBLE_EQ(statisticsOf({8.0, 1.0, 4.0, 2.0}).median, 3.0);
  EXPECT_DOUBLE_EQ(statisticsOf({5.0, 7.0}).median, 6.0);
}

TEST(ErrorStatistics, OfOneAndOfNone) {
  EXPECT_DOUBLE_EQ(statisticsOf({0.5}).median, 0.5);
  const ErrorStatistics none = statisticsOf({});
  EXPECT_EQ(none.count, 0);
  EXPECT_EQ(none.rmse, 0.0);
}

}  // namespace
}  // namespace oikos::metrics
