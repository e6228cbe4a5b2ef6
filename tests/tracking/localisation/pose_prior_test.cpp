// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/pose_prior.h"

#include <gtest/gtest.h>

namespace oikos::tracking {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

Eigen::Isometry3d at(double x_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(x_m, 0.0, 0.0));
}

const Eigen::Isometry3d kT_base_camera(Eigen::Translation3d(0.1, 0.0, 1.0));

TEST(PosePrior, KnowsNothingByDefault) {
  EXPECT_FALSE(PosePrior().findCamera(0));
}

TEST(PosePrior, InterpolatesAndAddsTheMount) {
  const PosePrior prior({{kSecond_ns, at(1.0)}, {kSecond_ns * 14 / 10, at(2.0)}}, kT_base_camera);
  ASSERT_TRUE(prior.findCamera(kSecond_ns));
  EXPECT_TRUE(prior.findCamera(kSecond_ns)->translation().isApprox(Eigen::Vector3d(1.1, 0.0, 1.0), 1e-12));
  ASSERT_TRUE(prior.findCamera(kSecond_ns * 12 / 10));
  EXPECT_TRUE(prior.findCamera(kSecond_ns * 12 / 10)->translation().isApprox(Eigen::Vector3d(1.6, 0.0, 1.0), 1e-9));
}

TEST(PosePrior, NothingOutsideOrInALongGap) {
  const PosePrior prior({{kSecond_ns, at(1.0)}, {2 * kSecond_ns, at(2.0)}}, kT_base_camera);
  EXPECT_FALSE(prior.findCamera(kSecond_ns / 2));
  EXPECT_FALSE(prior.findCamera(kSecond_ns * 3 / 2));
  EXPECT_FALSE(prior.findCamera(3 * kSecond_ns));
  EXPECT_TRUE(prior.findCamera(2 * kSecond_ns + 500'000));
}

TEST(PosePrior, OnePoseIsOfItsFrameOnly) {
  const PosePrior prior(at(3.0), kSecond_ns, kT_base_camera);
  EXPECT_TRUE(prior.findCamera(kSecond_ns));
  EXPECT_FALSE(prior.findCamera(kSecond_ns + 100'000'000));
}

}  // namespace
}  // namespace oikos::tracking
