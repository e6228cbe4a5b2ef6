// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry_priors.h"

#include <gtest/gtest.h>

#include "core/geometry/se3.h"

namespace oikos::mapping {
namespace {

constexpr std::int64_t kTenth_ns = 100'000'000;

/// A base that drives along x at 1 m/s and turns at 0.2 rad/s; one pose each tenth of a second from `first` to `last`.
Eigen::Isometry3d basePose(double time_s) {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  T_odom_base.linear() = Eigen::AngleAxisd(0.2 * time_s, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_odom_base.translation().x() = time_s;
  return T_odom_base;
}

recording::Trajectory odometry(int first, int last) {
  recording::Trajectory poses;
  for (int i = first; i <= last; ++i) {
    poses.push_back({i * kTenth_ns, basePose(0.1 * i)});
  }
  return poses;
}

Eigen::Isometry3d mount() {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  T_base_camera.translation() = Eigen::Vector3d(0.2, 0.0, 1.1);
  return T_base_camera;
}

Eigen::Isometry3d cameraMotion(double from_s, double to_s) {
  return (basePose(from_s) * mount()).inverse() * basePose(to_s) * mount();
}

KeyframeGraph graphAt(const std::vector<std::int64_t>& stamps_ns) {
  KeyframeGraph graph;
  for (const std::int64_t stamp_ns : stamps_ns) {
    graph.nodes.emplace_back().stamp_ns = stamp_ns;
  }
  return graph;
}

void expectSame(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double tolerance) {
  EXPECT_LT((a.translation() - b.translation()).norm(), tolerance);
  EXPECT_LT(Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle(), tolerance);
}

TEST(OdometryPriors, NeedOdometryAndTheMount) {
  const KeyframeGraph graph = graphAt({0, kTenth_ns});
  EXPECT_TRUE(motionPriors(WheelOdometry(), graph).empty());
  EXPECT_TRUE(motionPriors(WheelOdometry(std::nullopt, mount()), graph).empty());
  EXPECT_TRUE(motionPriors(WheelOdometry(odometry(0, 10), std::nullopt), graph).empty());
  EXPECT_EQ(motionPriors(WheelOdometry(odometry(0, 10), mount()), graph).size(), 1U);
}

TEST(OdometryPriors, AreTheCamerasMotionNotTheBases) {
  const auto priors = motionPriors(WheelOdometry(odometry(0, 40), mount()), graphAt({0, 10 * kTenth_ns, 30 * kTenth_ns}));
  ASSERT_EQ(priors.size(), 2U);
  EXPECT_EQ(priors[0].from, 0);
  EXPECT_EQ(priors[0].to, 1);
  expectSame(priors[0].T_from_to, cameraMotion(0.0, 1.0), 1e-12);
  EXPECT_EQ(priors[1].from, 1);
  EXPECT_EQ(priors[1].to, 2);
  expectSame(priors[1].T_from_to, cameraMotion(1.0, 3.0), 1e-12);
}

/// Between two readings on the geodesic; 0.1 s of a 0.2 rad/s turn bends it by 0.1 mm from the true path.
TEST(OdometryPriors, AreInterpolatedBetweenReadings) {
  const auto priors =
      motionPriors(WheelOdometry(odometry(0, 40), mount()), graphAt({5 * kTenth_ns + kTenth_ns / 4, 20 * kTenth_ns + kTenth_ns / 2}));
  ASSERT_EQ(priors.size(), 1U);
  expectSame(priors[0].T_from_to, cameraMotion(0.525, 2.05), 0.002);
}

TEST(OdometryPriors, EndWhereTheOdometryEnds) {
  const WheelOdometry wheels(odometry(10, 20), mount());
  EXPECT_EQ(motionPriors(wheels, graphAt({10 * kTenth_ns, 20 * kTenth_ns})).size(), 1U);
  EXPECT_TRUE(motionPriors(wheels, graphAt({10 * kTenth_ns - 1, 15 * kTenth_ns})).empty());
  EXPECT_TRUE(motionPriors(wheels, graphAt({15 * kTenth_ns, 20 * kTenth_ns + 1})).empty());
}

TEST(OdometryPriors, AreNotInterpolatedAcrossAGap) {
  recording::Trajectory with_gap = odometry(0, 10);
  const recording::Trajectory later = odometry(16, 30);  // 0.6 s later
  with_gap.insert(with_gap.end(), later.begin(), later.end());
  const WheelOdometry wheels(with_gap, mount());
  EXPECT_TRUE(motionPriors(wheels, graphAt({5 * kTenth_ns, 13 * kTenth_ns})).empty());
  EXPECT_EQ(motionPriors(wheels, graphAt({5 * kTenth_ns, 20 * kTenth_ns})).size(), 1U);  // across it both ends are known
  EXPECT_EQ(
      motionPriors(WheelOdometry({{{0, basePose(0.0)}, {5 * kTenth_ns, basePose(0.5)}}}, mount()), graphAt({0, 2 * kTenth_ns})).size(), 1U);
}

std::vector<TrackedFrame> framesWith(const std::vector<TrackingStatus>& statuses) {
  std::vector<TrackedFrame> frames;
  for (const TrackingStatus status : statuses) {
    TrackedFrame frame;
    frame.frame = static_cast<int>(frames.size());
    frame.stamp_ns = frame.frame * kTenth_ns;
    frame.status = status;
    frame.reference = 0;
    frames.push_back(frame);
  }
  return frames;
}

TEST(OdometryPriors, CarryLostFramesOnFromTheLastThatWasSeen) {
  using enum TrackingStatus;
  const auto frames = framesWith({kStart, kTracked, kLost, kLost, kLost, kRelocalised, kLost});
  const Eigen::Isometry3d T_world_odom = Eigen::Translation3d(3.0, 2.0, 1.0) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY());
  std::vector<Eigen::Isometry3d> poses(frames.size(), Eigen::Isometry3d::Identity());
  for (const std::size_t seen : {0U, 1U, 5U}) {
    poses[seen] = T_world_odom * basePose(0.1 * static_cast<double>(seen)) * mount();
  }
  const std::vector<char> carried = carryLostFrames(WheelOdometry(odometry(0, 10), mount()), frames, poses);
  EXPECT_EQ(carried, (std::vector<char>{0, 0, 1, 1, 1, 0, 1}));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    expectSame(poses[i], T_world_odom * basePose(0.1 * static_cast<double>(i)) * mount(), 1e-12);
  }
}

TEST(OdometryPriors, CarryAllFramesOnFromTheFirstIfNothingWasEverSeen) {
  const auto frames = framesWith(std::vector<TrackingStatus>(6, TrackingStatus::kLost));
  const Eigen::Isometry3d T_world_odom = Eigen::Translation3d(3.0, 2.0, 1.0) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY());
  std::vector<Eigen::Isometry3d> poses(frames.size(), T_world_odom * basePose(0.0) * mount());
  EXPECT_EQ(carryLostFrames(WheelOdometry(odometry(0, 10), mount()), frames, poses), std::vector<char>(6, 1));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    expectSame(poses[i], T_world_odom * basePose(0.1 * static_cast<double>(i)) * mount(), 1e-12);
  }
  std::vector<Eigen::Isometry3d> none;
  EXPECT_TRUE(carryLostFrames(WheelOdometry(odometry(0, 10), mount()), {}, none).empty());
}

TEST(OdometryPriors, LeaveLostFramesAloneWhereTheyKnowNothing) {
  using enum TrackingStatus;
  const auto frames = framesWith({kLost, kStart, kLost, kLost});
  const std::vector<Eigen::Isometry3d> before(4, Eigen::Isometry3d(Eigen::Translation3d(1.0, 2.0, 3.0)));
  std::vector<Eigen::Isometry3d> poses = before;
  const std::vector<char> carried = carryLostFrames(WheelOdometry(odometry(0, 2), mount()), frames, poses);
  EXPECT_EQ(carried, (std::vector<char>{0, 0, 1, 0}));  // nothing before the first, no odometry at the last
  EXPECT_EQ(poses[0].matrix(), before[0].matrix());
  EXPECT_EQ(poses[3].matrix(), before[3].matrix());
  EXPECT_EQ(carryLostFrames(WheelOdometry(), frames, poses), std::vector<char>(4, 0));
}

}  // namespace
}  // namespace oikos::mapping
