// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/voxel_ball.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oikos::mapping {
namespace {

TEST(VoxelBall, HoldsAllStepsNearerOnesFirst) {
  const auto ball = voxelBall(0.08, 0.05);  // 1 and √2 voxels, not √3
  ASSERT_EQ(ball.size(), 19U);
  EXPECT_EQ(ball.front().offset, 0U);
  for (std::size_t i = 1; i < ball.size(); ++i) {
    EXPECT_GE(ball[i].length_m, ball[i - 1].length_m);
  }
  EXPECT_NEAR(ball.back().length_m, 0.05 * std::sqrt(2.0), 1e-12);
}

TEST(VoxelBall, StepsLeadBothWays) {
  const VoxelKey key = packVoxelKey(32768, 7, 40000);
  for (const VoxelStep& step : voxelBall(0.1, 0.05)) {
    const auto to = unpackVoxelKey(stepFrom(key, step.offset));
    const double x = to[0] - 32768.0;
    const double y = to[1] - 7.0;
    const double z = to[2] - 40000.0;
    EXPECT_NEAR(0.05 * std::sqrt(x * x + y * y + z * z), step.length_m, 1e-12);
  }
}

}  // namespace
}  // namespace oikos::mapping
