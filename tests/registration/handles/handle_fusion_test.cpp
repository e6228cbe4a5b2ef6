// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/handle_fusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/error.h"
#include "registration/handles/blurred_bar.h"

namespace oikos::registration {
namespace {

const Eigen::Isometry3d kTrue = Eigen::Translation3d(0.03, 0.2, -0.1) * Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.0, 0.6, 0.8));

HandleEstimate seenAt(const Eigen::Isometry3d& T_part_handle, double sigma_m) {
  HandleEstimate estimate;
  estimate.status = HandleStatus::kFound;
  estimate.T_part_handle = T_part_handle;
  estimate.covariance.diagonal() << geometry::Vector6d::Constant(sigma_m * sigma_m);
  estimate.length_m = 0.16;
  return estimate;
}

TEST(HandleFusion, NothingSeenIsNotInView) {
  EXPECT_EQ(HandleFusion({}).result().status, HandleStatus::kNotInView);
  HandleFusion fusion({});
  for (const HandleStatus status : {HandleStatus::kHidden, HandleStatus::kNotSeen, HandleStatus::kHidden}) {
    HandleEstimate estimate = seenAt(kTrue, 0.01);
    estimate.status = status;
    fusion.add(estimate);
  }
  EXPECT_EQ(fusion.result().status, HandleStatus::kHidden);
  EXPECT_EQ(fusion.result().images, 3);
  EXPECT_EQ(fusion.result().seen, 0);
  EXPECT_EQ(fusion.result().T_part_handle.matrix(), kTrue.matrix());
}

TEST(HandleFusion, ImagesThatAgree) {
  constexpr int kImages = 60;
  constexpr double kSigma_m = 0.004;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  HandleFusion fusion({});
  for (int i = 0; i < kImages; ++i) {
    geometry::Vector6d xi;
    for (double& x : xi) {
      x = kSigma_m * normal(random);
    }
    fusion.add(seenAt(kTrue * geometry::expSe3(xi), kSigma_m));
  }
  const FusedHandle fused = fusion.result();
  const geometry::Vector6d off = geometry::logSe3(kTrue.inverse() * fused.T_part_handle);
  EXPECT_EQ(fused.status, HandleStatus::kFound);
  EXPECT_EQ(fused.seen, kImages);
  EXPECT_LT(off.head<3>().norm(), 3.0 * std::sqrt(3.0 / kImages) * kSigma_m);
  EXPECT_LT(off.tail<3>().norm(), 3.0 * std::sqrt(3.0 / kImages) * kSigma_m);
  EXPECT_NEAR(fused.spread_m, std::sqrt(3.0) * kSigma_m, 0.2 * std::sqrt(3.0) * kSigma_m);
  EXPECT_LT(fused.covariance(0, 0), kSigma_m * kSigma_m);
  EXPECT_GT(fused.covariance(0, 0), kSigma_m * kSigma_m / kImages);  // images of one place repeat each other
  EXPECT_DOUBLE_EQ(fused.length_m, 0.16);
}

TEST(HandleFusion, ImagesThatDifferFromTheRestAreLeftOut) {
  HandleFusion fusion({});
  for (int i = 0; i < 12; ++i) {
    const bool is_wrong = i % 4 == 3;
    const double off_m = is_wrong ? 0.04 : 0.001 * (i % 3 - 1);
    fusion.add(seenAt(kTrue * Eigen::Translation3d(0.0, off_m, 0.0), 0.002));
  }
  const FusedHandle fused = fusion.result();
  EXPECT_EQ(fused.outliers, 3);
  EXPECT_LT((fused.T_part_handle.translation() - kTrue.translation()).norm(), 0.001);
  EXPECT_LT(fused.spread_m, 0.002);
}

TEST(HandleFusion, MoreExactImagesCountForMore) {
  HandleFusion fusion({});
  fusion.add(seenAt(kTrue, 0.001));
  fusion.add(seenAt(kTrue * Eigen::Translation3d(0.0, 0.0, 0.01), 0.02));
  EXPECT_LT((fusion.result().T_part_handle.translation() - kTrue.translation()).norm(), 0.001);
}

TEST(HandleFusion, WhatIsThePriorsStays) {
  HandleFusion fusion({});
  HandleEstimate estimate = seenAt(kTrue, 0.01);
  estimate.shared(2, 2) = 0.8 * estimate.covariance(2, 2);
  for (int i = 0; i < 50; ++i) {
    fusion.add(estimate);
  }
  EXPECT_GE(fusion.result().covariance(2, 2), estimate.shared(2, 2));
}

TEST(HandleFusion, OneHandleOnly) {
  HandleFusion fusion({});
  HandleEstimate estimate = seenAt(kTrue, 0.01);
  fusion.add(estimate);
  estimate.handle = 1;
  EXPECT_THROW(fusion.add(estimate), base::ContractViolation);
  EXPECT_THROW(HandleFusion({.freedom = 0.0}), base::ContractViolation);
}

TEST(BlurredBar, DerivativesAreThoseOfDifferences) {
  const Bar bar = {0.004, -0.003, 0.02, 0.03, 0.001, 0.08, 0.006, 0.005};
  constexpr double kStep = 1e-7;
  for (const auto& [along_m, across_m] :
       {std::pair(0.01, 0.001), std::pair(0.083, 0.0), std::pair(-0.077, -0.01), std::pair(0.03, 0.006)}) {
    const BarReading reading = BlurredBar(bar).at(along_m, across_m);
    for (int i = 0; i < 8; ++i) {
      BarVector more = bar.vector();
      BarVector less = bar.vector();
      more[i] += kStep;
      less[i] -= kStep;
      const double difference =
          BlurredBar(Bar::from(more)).at(along_m, across_m).height_m - BlurredBar(Bar::from(less)).at(along_m, across_m).height_m;
      EXPECT_NEAR(reading.derivative[i], difference / (2.0 * kStep), 1e-6) << i << " at " << along_m << ", " << across_m;
    }
  }
}

}  // namespace
}  // namespace oikos::registration
