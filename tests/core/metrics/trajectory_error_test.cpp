// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/trajectory_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "core/base/error.h"

namespace oikos::metrics {
namespace {

using recording::StampedPose;
using recording::Trajectory;

constexpr std::int64_t kSecond = 1'000'000'000;

StampedPose poseAt(double stamp_s, const Eigen::Vector3d& position, double yaw_rad = 0.0) {
  StampedPose pose;
  pose.stamp_ns = std::llround(stamp_s * 1e9);
  pose.T_map_camera.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.T_map_camera.translation() = position;
  return pose;
}

Eigen::Isometry3d someMotion() {
  Eigen::Isometry3d T_other_map = Eigen::Isometry3d::Identity();
  T_other_map.linear() = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  T_other_map.translation() = Eigen::Vector3d(4, -5, 6);
  return T_other_map;
}

Trajectory moved(Trajectory trajectory, const Eigen::Isometry3d& T_other_map) {
  for (StampedPose& pose : trajectory) {
    pose.T_map_camera = T_other_map * pose.T_map_camera;
  }
  return trajectory;
}

/// 30 Hz on a wavy circle, turning with it.
Trajectory wavyCircle(int count) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 0.02 * i;
    trajectory.push_back(
        poseAt(100.0 + i / 30.0, {2 * std::cos(angle_rad), 2 * std::sin(angle_rad), 0.3 * std::sin(5 * angle_rad)}, angle_rad));
  }
  return trajectory;
}

// A square's corners at 0, 1, 2, 3 s, the x axis stretched by a tenth and everything moved elsewhere. By hand: aligned errors
// 0.1, 0, 0.1, 0 m; each side is 0.1 m too long in x.
TEST(TrajectoryError, HandComputedCase) {
  const Trajectory truth = {poseAt(0, {1, 0, 0}), poseAt(1, {0, 1, 0}), poseAt(2, {-1, 0, 0}), poseAt(3, {0, -1, 0})};
  const Trajectory stretched = {poseAt(0, {1.1, 0, 0}), poseAt(1, {0, 1, 0}), poseAt(2, {-1.1, 0, 0}), poseAt(3, {0, -1, 0})};
  const TrajectoryErrorConfig config{.distance_m = 1.45};
  const TrajectoryError result = evaluateTrajectory(moved(stretched, someMotion()), truth, config);
  ASSERT_EQ(result.status, TrajectoryErrorStatus::kEvaluated);
  EXPECT_EQ(result.association_count, 4);
  EXPECT_DOUBLE_EQ(result.duration_s, 3.0);
  EXPECT_NEAR(result.truth_path_m, 3 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(result.absolute_m.rmse, 0.1 / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(result.absolute_m.mean, 0.05, 1e-12);
  EXPECT_NEAR(result.absolute_m.median, 0.05, 1e-12);
  EXPECT_NEAR(result.absolute_m.max, 0.1, 1e-12);
  EXPECT_NEAR(result.motionless_absolute_m, 1.0, 1e-12);
  EXPECT_EQ(result.per_interval.translation_m.count, 3);
  EXPECT_NEAR(result.per_interval.translation_m.rmse, 0.1, 1e-12);
  EXPECT_NEAR(result.per_interval.rotation_rad.max, 0.0, 1e-9);
  EXPECT_EQ(result.per_distance.translation_m.count, 3);
  EXPECT_NEAR(result.per_distance.translation_m.median, 0.1, 1e-12);
}

TEST(TrajectoryError, AKnownTurnPerSecondIsTheRotationError) {
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i < 10; ++i) {
    truth.push_back(poseAt(i, {0.1 * i * i, 0.2 * i, 0}));
    estimate.push_back(poseAt(i, {0.1 * i * i, 0.2 * i, 0}, 0.01 * i));
  }
  const TrajectoryError result = evaluateTrajectory(estimate, truth);
  EXPECT_EQ(result.per_interval.rotation_rad.count, 9);
  EXPECT_NEAR(result.per_interval.rotation_rad.rmse, 0.01, 1e-9);
  EXPECT_NEAR(result.per_interval.rotation_rad.max, 0.01, 1e-9);
  EXPECT_NEAR(result.absolute_m.rmse, 0.0, 1e-9);
}

TEST(TrajectoryError, KnownMotionIsUndoneAndKnownNoiseMeasured) {
  constexpr double kNoise_m = 0.02;
  constexpr int kCount = 3000;
  const Trajectory truth = wavyCircle(kCount);
  Trajectory estimate = moved(truth, someMotion());
  std::mt19937 random(1);
  std::normal_distribution<double> noise_m(0.0, kNoise_m);
  for (StampedPose& pose : estimate) {
    pose.T_map_camera.translation() += Eigen::Vector3d(noise_m(random), noise_m(random), noise_m(random));
  }
  const TrajectoryError result = evaluateTrajectory(estimate, truth);
  ASSERT_EQ(result.status, TrajectoryErrorStatus::kEvaluated);
  EXPECT_EQ(result.association_count, kCount);
  EXPECT_NEAR(result.absolute_m.rmse, kNoise_m * std::sqrt(3.0), 0.03 * kNoise_m);
  EXPECT_NEAR(result.per_interval.translation_m.rmse, kNoise_m * std::sqrt(6.0), 0.06 * kNoise_m);
  EXPECT_EQ(result.per_interval.translation_m.count, kCount - 30);
  const Eigen::Isometry3d difference = result.alignment.T_a_b * someMotion();
  EXPECT_LT(difference.translation().norm(), 5 * kNoise_m * 10.0 / std::sqrt(static_cast<double>(kCount)));
  EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), 5 * kNoise_m / std::sqrt(static_cast<double>(kCount)));
}

TEST(TrajectoryError, ScaleIsFreedOnRequestOnly) {
  const Trajectory truth = wavyCircle(300);
  Trajectory half = truth;
  for (StampedPose& pose : half) {
    pose.T_map_camera.translation() *= 0.5;
  }
  EXPECT_GT(evaluateTrajectory(half, truth).absolute_m.rmse, 0.5);
  const TrajectoryError scaled = evaluateTrajectory(half, truth, {.scale = geometry::AlignmentScale::kFree});
  EXPECT_NEAR(scaled.alignment.scale, 2.0, 1e-9);
  EXPECT_LT(scaled.absolute_m.rmse, 1e-9);
  EXPECT_LT(scaled.per_interval.translation_m.max, 1e-9);
  EXPECT_LT(scaled.per_distance.translation_m.max, 1e-9);
}

TEST(TrajectoryError, WhichPoseClosesASecond) {
  Trajectory truth;
  for (const double stamp_s : {0.0, 0.99, 1.02, 1.5}) {
    truth.push_back(poseAt(stamp_s, {stamp_s, stamp_s * stamp_s, 0}));
  }
  Trajectory estimate = truth;
  estimate[1].T_map_camera.translation().z() += 0.5;
  const TrajectoryError after = evaluateTrajectory(estimate, truth);
  EXPECT_EQ(after.per_interval.translation_m.count, 1);
  EXPECT_NEAR(after.per_interval.translation_m.max, 0.0, 1e-12);
  const TrajectoryError nearest = evaluateTrajectory(estimate, truth, {.second_pairs = SecondPairs::kNearest});
  EXPECT_EQ(nearest.per_interval.translation_m.count, 1);
  EXPECT_NEAR(nearest.per_interval.translation_m.max, 0.5, 1e-12);
}

TEST(TrajectoryError, StampsRoundedToAMicrosecondStillMakeAWholeSecond) {
  Trajectory truth = wavyCircle(120);
  for (StampedPose& pose : truth) {
    pose.stamp_ns = pose.stamp_ns / 1000 * 1000;
  }
  EXPECT_EQ(evaluateTrajectory(truth, truth).per_interval.translation_m.count, 90);
}

TEST(TrajectoryError, AMetreAlongTheEstimateOrTheTruth) {
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i <= 40; ++i) {
    truth.push_back(poseAt(i, {0.1 * i, 0, 0}));
    estimate.push_back(poseAt(i, {0.1 * i, 0.1 * (i % 2), 0}));
  }
  const TrajectoryErrorConfig along_truth{.metre_pairs = MetrePairs::kAlongTruth, .distance_slack_ratio = 0.05};
  EXPECT_EQ(evaluateTrajectory(estimate, truth, along_truth).per_distance.translation_m.count, 31);
  // Its zigzag is 0.141 m a step: 7 steps are 0.99 m. The seventh is always on the other side: 0.1 m off.
  const TrajectoryError along_estimate = evaluateTrajectory(estimate, truth);
  EXPECT_EQ(along_estimate.per_distance.translation_m.count, 34);
  EXPECT_NEAR(along_estimate.per_distance.translation_m.median, 0.1, 1e-12);
}

TEST(TrajectoryError, AMotionlessEstimateScoresTheMotionlessError) {
  const Trajectory truth = wavyCircle(300);
  Trajectory still = truth;
  for (StampedPose& pose : still) {
    pose.T_map_camera = truth.front().T_map_camera;
  }
  const TrajectoryError result = evaluateTrajectory(still, truth);
  EXPECT_EQ(result.status, TrajectoryErrorStatus::kUndetermined);
  EXPECT_NEAR(result.absolute_m.rmse, result.motionless_absolute_m, 1e-12);
  EXPECT_EQ(result.per_distance.translation_m.count, 0);
}

TEST(TrajectoryError, EveryOtherStatus) {
  const Trajectory truth = wavyCircle(30);
  EXPECT_EQ(evaluateTrajectory({}, truth).status, TrajectoryErrorStatus::kEmptyInput);
  EXPECT_EQ(evaluateTrajectory(truth, {}).status, TrajectoryErrorStatus::kEmptyInput);
  Trajectory later = truth;
  for (StampedPose& pose : later) {
    pose.stamp_ns += 1000 * kSecond;
  }
  EXPECT_EQ(evaluateTrajectory(later, truth).status, TrajectoryErrorStatus::kNoOverlap);
  const TrajectoryError two = evaluateTrajectory({truth[0], truth[1]}, truth);
  EXPECT_EQ(two.status, TrajectoryErrorStatus::kTooFewPairs);
  EXPECT_EQ(two.association_count, 2);
  EXPECT_EQ(two.absolute_m.count, 0);
}

TEST(TrajectoryError, ALineIsMeasuredButCalledUndetermined) {
  Trajectory truth;
  for (int i = 0; i < 50; ++i) {
    truth.push_back(poseAt(i, {0.1 * i, 0, 0}));
  }
  const TrajectoryError result = evaluateTrajectory(moved(truth, someMotion()), truth);
  EXPECT_EQ(result.status, TrajectoryErrorStatus::kUndetermined);
  EXPECT_LT(result.absolute_m.max, 1e-9);
}

TEST(TrajectoryError, ConfigurationSaysWhatIsWrong) {
  const TrajectoryErrorConfig wrong{.interval_s = 0.0, .distance_slack_ratio = -0.5};
  ASSERT_EQ(wrong.validate().size(), 2U);
  EXPECT_EQ(wrong.validate()[0], "trajectory_error.interval_s = 0: must be > 0");
  EXPECT_THROW(static_cast<void>(evaluateTrajectory({}, {}, wrong)), base::ContractViolation);
}

TEST(TrajectoryError, NamesRoundTrip) {
  const auto expectRoundTrip = []<class Enum>(Enum) {
    for (const std::string& name : base::enumNames<Enum>()) {
      EXPECT_EQ(base::toString(*base::findEnum<Enum>(name)), name);
    }
  };
  expectRoundTrip(TrajectoryErrorStatus{});
  expectRoundTrip(SecondPairs{});
  expectRoundTrip(MetrePairs{});
  expectRoundTrip(Association{});
}

}  // namespace
}  // namespace oikos::metrics
