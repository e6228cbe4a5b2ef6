// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/angle_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace oikos::recognition {
namespace {

AngleFit fitAt(double x_m, std::vector<double> unexplained, double cost) {
  return {{x_m, 0.0}, std::move(unexplained), cost};
}

TEST(MergeFits, OneIsItself) {
  const AngleFit merged = mergeFits({fitAt(0.001, {0.5, 0.1, 0.4}, 3.0)});
  EXPECT_EQ(merged.centre_patch, Eigen::Vector2d(0.001, 0.0));
  EXPECT_EQ(merged.unexplained, (std::vector<double>{0.5, 0.1, 0.4}));
}

TEST(MergeFits, TheLikelierPlaceIsKeptWhateverTheOrder) {
  const AngleFit likely = fitAt(0.001, {0.5, 0.2, 0.4}, -40.0);
  const AngleFit unlikely = fitAt(0.02, {0.01, 0.3, 0.3}, 10.0);
  for (const AngleFit& merged : {mergeFits({likely, unlikely}), mergeFits({unlikely, likely})}) {
    EXPECT_EQ(merged.centre_patch, likely.centre_patch);
    EXPECT_EQ(merged.cost, likely.cost);
    EXPECT_EQ(merged.unexplained, likely.unexplained);  // 50 dearer: exp(50 / 15) times 0.2 at its best angle
  }
}

TEST(MergeFits, ARivalAngleOfAnEquallyLikelyPlaceIsAsLikely) {
  const AngleFit merged = mergeFits({fitAt(0.0, {0.6, 0.2, 0.6}, -5.0), fitAt(0.01, {0.1, 0.3, 0.3}, -5.0)});
  // The second, scaled so that its best angle is as good as the first's.
  ASSERT_EQ(merged.unexplained.size(), 3U);
  EXPECT_NEAR(merged.unexplained[0], 0.2, 1e-12);
  EXPECT_NEAR(merged.unexplained[1], 0.2, 1e-12);
  EXPECT_NEAR(merged.unexplained[2], 0.6, 1e-12);
}

TEST(MergeFits, NoneIsABrokenContract) {
  EXPECT_THROW((void)mergeFits({}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::recognition
