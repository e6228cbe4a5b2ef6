// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/share_interval.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace oikos::metrics {
namespace {

TEST(WilsonInterval, KnownValues) {
  const ShareInterval none = wilsonInterval(0, 10);
  EXPECT_NEAR(none.low, 0.0, 1e-12);
  EXPECT_NEAR(none.high, 0.27753, 1e-5);
  const ShareInterval all = wilsonInterval(10, 10);
  EXPECT_NEAR(all.low, 0.72247, 1e-5);
  EXPECT_NEAR(all.high, 1.0, 1e-12);
  const ShareInterval half = wilsonInterval(50, 100);
  EXPECT_NEAR(half.low, 0.40383, 1e-5);
  EXPECT_NEAR(half.high, 0.59617, 1e-5);
}

TEST(WilsonInterval, OfNothingItIsEverything) {
  EXPECT_EQ(wilsonInterval(0, 0).low, 0.0);
  EXPECT_EQ(wilsonInterval(0, 0).high, 1.0);
  EXPECT_THROW((void)wilsonInterval(3, 2), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::metrics
