// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/pose_carrier.h"

#include <gtest/gtest.h>

#include "tests/mapping/graph/synthetic_drive.h"
#include "tests/mapping/relocalise/saved_room.h"
#include "tests/support/config_rules_check.h"

namespace oikos::tracking {
namespace {

constexpr int kLevels = 5;
constexpr double kChiSquared = 22.5;  // 6 degrees of freedom, one in a thousand

CarriedPose knownAt(const Eigen::Isometry3d& T_map_camera) {
  geometry::Vector6d sigma;
  sigma << 0.005, 0.005, 0.005, 0.002, 0.002, 0.002;
  return {T_map_camera, sigma.cwiseAbs2().asDiagonal()};
}

geometry::Vector6d errorOf(const CarriedPose& pose, const Eigen::Isometry3d& T_map_camera) {
  return geometry::logSe3(pose.T_map_camera.inverse() * T_map_camera);
}

double normalised(const CarriedPose& pose, const Eigen::Isometry3d& T_map_camera) {
  const geometry::Vector6d xi = errorOf(pose, T_map_camera);
  return xi.dot(pose.covariance.ldlt().solve(xi));
}

/// What wheels without error say of the drive.
mapping::WheelOdometry exactWheels(const test::SyntheticRecording& drive) {
  return {drive.truth(), Eigen::Isometry3d::Identity()};
}

/// A turn by 100 degrees on a circle, of which no landmark lasts.
TEST(PoseCarrier, FollowsTheCameraByItsPictures) {
  for (std::uint64_t seed = 1; seed < 3; ++seed) {
    const auto drive = mapping::recordingOf(mapping::turnAround(0.0, 100.0, 20), {}, seed);
    PoseCarrier carrier(drive.camera(), nullptr, kLevels, {});
    carrier.start(drive.read(0, recording::Channels::kGray), knownAt(drive.truth()[0].T_map_camera));
    double before = 0.0;
    for (int i = 1; i < drive.frameCount(); ++i) {
      const auto carried = carrier.carry(drive.read(i, recording::Channels::kGray));
      ASSERT_TRUE(carried) << i;
      const Eigen::Isometry3d T_map_camera = drive.truth()[static_cast<std::size_t>(i)].T_map_camera;
      EXPECT_LT(errorOf(*carried, T_map_camera).head<3>().norm(), 0.03) << i;
      EXPECT_LT(errorOf(*carried, T_map_camera).tail<3>().norm(), 0.02) << i;
      EXPECT_LT(normalised(*carried, T_map_camera), kChiSquared) << i;
      const double doubt = carried->covariance.bottomRightCorner<3, 3>().trace();
      EXPECT_GT(doubt, 0.98 * before) << i;  // what a motion adds, none takes away
      before = doubt;
    }
  }
}

TEST(PoseCarrier, ByTheWheelsWherePicturesShowNothing) {
  const auto drive = mapping::recordingOf(mapping::turnAround(0.0, 36.0, 9), {3, 4}, 1);
  const mapping::WheelOdometry wheels = exactWheels(drive);
  PoseCarrier carrier(drive.camera(), &wheels, kLevels, {});
  carrier.start(drive.read(0, recording::Channels::kGray), knownAt(drive.truth()[0].T_map_camera));
  for (int i = 1; i < drive.frameCount(); ++i) {
    const auto carried = carrier.carry(drive.read(i, recording::Channels::kGray));
    ASSERT_TRUE(carried) << i;
    EXPECT_LT(normalised(*carried, drive.truth()[static_cast<std::size_t>(i)].T_map_camera), kChiSquared) << i;
  }
}

TEST(PoseCarrier, WithoutWheelsAFrameThatShowsNothingIsNone) {
  const auto drive = mapping::recordingOf(mapping::turnAround(0.0, 32.0, 8), {4}, 1);
  PoseCarrier carrier(drive.camera(), nullptr, kLevels, {});
  carrier.start(drive.read(0, recording::Channels::kGray), knownAt(drive.truth()[0].T_map_camera));
  for (int i = 1; i < drive.frameCount(); ++i) {
    const auto carried = carrier.carry(drive.read(i, recording::Channels::kGray));
    ASSERT_EQ(carried.has_value(), i != 4) << i;  // seen again by the landmarks of a frame before it
    if (carried) {
      EXPECT_LT(normalised(*carried, drive.truth()[static_cast<std::size_t>(i)].T_map_camera), kChiSquared) << i;
    }
  }
}

/// A door that fills the picture and swings: the room seems to turn, and the robot stands still.
TEST(PoseCarrier, PicturesThatTheWheelsContradictAreNotBelieved) {
  const auto drive = mapping::recordingOf(mapping::turnAround(0.0, 20.0, 5), {}, 1);
  recording::Trajectory still = drive.truth();
  for (recording::StampedPose& pose : still) {
    pose.T_map_camera = still.front().T_map_camera;
  }
  const mapping::WheelOdometry wheels(still, Eigen::Isometry3d::Identity());
  PoseCarrier carrier(drive.camera(), &wheels, kLevels, {});
  const Eigen::Isometry3d T_map_camera = drive.truth()[0].T_map_camera;
  carrier.start(drive.read(0, recording::Channels::kGray), knownAt(T_map_camera));
  for (int i = 1; i < drive.frameCount(); ++i) {
    const auto carried = carrier.carry(drive.read(i, recording::Channels::kGray));
    ASSERT_TRUE(carried) << i;
    EXPECT_LT(errorOf(*carried, T_map_camera).norm(), 1e-9) << i;
  }
}

TEST(PoseCarrier, GivesUpWhatIsInTooMuchDoubt) {
  const auto drive = mapping::recordingOf(mapping::turnAround(0.0, 60.0, 15), {}, 1);
  CarryConfig config;
  config.max_sigma_deg = 0.25;
  config.turn_share = 0.02;
  PoseCarrier carrier(drive.camera(), nullptr, kLevels, config);
  EXPECT_FALSE(carrier.carry(drive.read(0, recording::Channels::kGray)));  // from where?
  carrier.start(drive.read(0, recording::Channels::kGray), knownAt(drive.truth()[0].T_map_camera));
  EXPECT_TRUE(carrier.carry(drive.read(1, recording::Channels::kGray)));
  int i = 2;
  while (i < drive.frameCount() && carrier.carry(drive.read(i, recording::Channels::kGray))) {
    ++i;
  }
  EXPECT_GT(i, 2);
  EXPECT_LT(i, drive.frameCount());
  EXPECT_FALSE(carrier.carry(drive.read(i, recording::Channels::kGray)));
  carrier.start(drive.read(i, recording::Channels::kGray), knownAt(drive.truth()[static_cast<std::size_t>(i)].T_map_camera));
  EXPECT_TRUE(carrier.carry(drive.read(std::min(i + 1, drive.frameCount() - 1), recording::Channels::kGray)));
}

TEST(PoseCarrier, AGapInTimeEndsIt) {
  const auto drive = mapping::recordingOf(mapping::turnAround(0.0, 4.0, 2), {}, 1);
  PoseCarrier carrier(drive.camera(), nullptr, kLevels, {});
  carrier.start(drive.read(0, recording::Channels::kGray), knownAt(drive.truth()[0].T_map_camera));
  camera::RgbdFrame late = drive.read(1, recording::Channels::kGray);
  late.stamp_ns += 1'000'000'000;
  EXPECT_FALSE(carrier.carry(late));
}

TEST(CarryConfig, RulesAreChecked) {
  EXPECT_TRUE(base::validateConfig(CarryConfig{}).empty());
  CarryConfig config;
  config.max_sigma_m = 0.0;
  config.fresh_share = 1.5;
  config.wheel_sigma_m = -1.0;
  EXPECT_EQ(config.validate(), (std::vector<std::string>{"max_sigma_m = 0: must be > 0", "fresh_share = 1.5: must be from 0 to 1",
                                                         "wheel_sigma_m = -1: must be >= 0"}));
}

}  // namespace
}  // namespace oikos::tracking
