// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/trajectory_association.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numbers>

namespace oikos::metrics {
namespace {

using recording::StampedPose;
using recording::Trajectory;

constexpr std::int64_t kMillisecond = 1'000'000;

StampedPose poseAt(std::int64_t stamp_ms, double x_m, double yaw_rad = 0.0) {
  StampedPose pose;
  pose.stamp_ns = stamp_ms * kMillisecond;
  pose.T_map_camera.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.T_map_camera.translation().x() = x_m;
  return pose;
}

TEST(TrajectoryAssociation, InterpolatesTheTruthAtTheEstimatesStamp) {
  const Trajectory truth = {poseAt(0, 0.0, 0.0), poseAt(20, 2.0, 0.4)};
  const auto pairs = associate({poseAt(5, 7.0)}, truth, Association::kInterpolated, 20 * kMillisecond);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].stamp_ns, 5 * kMillisecond);
  EXPECT_DOUBLE_EQ(pairs[0].T_estimate_camera.translation().x(), 7.0);
  EXPECT_DOUBLE_EQ(pairs[0].T_truth_camera.translation().x(), 0.5);
  EXPECT_NEAR(Eigen::AngleAxisd(pairs[0].T_truth_camera.linear()).angle(), 0.1, 1e-12);
}

TEST(TrajectoryAssociation, InterpolatesOverTheShorterArc) {
  const double nearly_pi_rad = std::numbers::pi - 0.1;
  const Trajectory truth = {poseAt(0, 0.0, nearly_pi_rad), poseAt(20, 0.0, -nearly_pi_rad)};
  const auto pairs = associate({poseAt(10, 0.0)}, truth, Association::kInterpolated, 20 * kMillisecond);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(Eigen::AngleAxisd(pairs[0].T_truth_camera.linear()).angle(), std::numbers::pi, 1e-9);
}

TEST(TrajectoryAssociation, InAGapOfTheTruthOnlyItsRimsCount) {
  const Trajectory truth = {poseAt(0, 0.0), poseAt(1000, 1.0)};
  const Trajectory estimate = {poseAt(19, 0.0), poseAt(20, 0.0), poseAt(500, 0.0), poseAt(981, 0.0)};
  const auto pairs = associate(estimate, truth, Association::kInterpolated, 20 * kMillisecond);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].stamp_ns, 19 * kMillisecond);
  EXPECT_DOUBLE_EQ(pairs[1].T_truth_camera.translation().x(), 0.981);
}

TEST(TrajectoryAssociation, BeyondTheTruthsEndsOnlyAMillisecondIsForgiven) {
  const Trajectory truth = {poseAt(100, 1.0), poseAt(120, 2.0)};
  const Trajectory estimate = {poseAt(98, 0.0), poseAt(99, 0.0), poseAt(121, 0.0), poseAt(122, 0.0)};
  const auto pairs = associate(estimate, truth, Association::kInterpolated, 20 * kMillisecond);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_DOUBLE_EQ(pairs[0].T_truth_camera.translation().x(), 1.0);
  EXPECT_DOUBLE_EQ(pairs[1].T_truth_camera.translation().x(), 2.0);
}

// As associate.py: the closest pair first, each stamp once. 10 takes 10; 11 would be nearest to 10, too, and gets 14.
TEST(TrajectoryAssociation, NearestUsesEachTrueStampOnce) {
  const Trajectory truth = {poseAt(10, 1.0), poseAt(14, 2.0)};
  const auto pairs = associate({poseAt(11, 0.0), poseAt(10, 0.0), poseAt(90, 0.0)}, truth, Association::kNearest, 20 * kMillisecond);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].stamp_ns, 10 * kMillisecond);
  EXPECT_DOUBLE_EQ(pairs[0].T_truth_camera.translation().x(), 1.0);
  EXPECT_DOUBLE_EQ(pairs[1].T_truth_camera.translation().x(), 2.0);
}

TEST(TrajectoryAssociation, AnyOrderAndNonFinitePoses) {
  const Trajectory truth = {poseAt(40, 4.0), poseAt(0, 0.0), poseAt(20, 2.0)};
  const Trajectory estimate = {poseAt(30, 0.0), poseAt(10, std::numeric_limits<double>::quiet_NaN()), poseAt(0, 0.0)};
  const auto pairs = associate(estimate, truth, Association::kInterpolated, 20 * kMillisecond);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].stamp_ns, 0);
  EXPECT_DOUBLE_EQ(pairs[1].T_truth_camera.translation().x(), 3.0);
}

TEST(TrajectoryAssociation, NothingToPair) {
  EXPECT_TRUE(associate({}, {poseAt(0, 0.0)}, Association::kInterpolated, kMillisecond).empty());
  EXPECT_TRUE(associate({poseAt(0, 0.0)}, {}, Association::kNearest, kMillisecond).empty());
}

}  // namespace
}  // namespace oikos::metrics
