// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/carried_frames.h"

#include <gtest/gtest.h>

#include "core/geometry/se3.h"

namespace oikos::mapping {
namespace {

/// A frame a tenth of a second, 10 cm apart along x.
recording::Trajectory straight(int frames) {
  recording::Trajectory trajectory;
  for (int i = 0; i < frames; ++i) {
    trajectory.push_back({i * 100'000'000LL, Eigen::Isometry3d(Eigen::Translation3d(0.1 * i, 0.0, 1.0))});
  }
  return trajectory;
}

Eigen::Isometry3d moved(double y_m, double yaw_rad) {
  return Eigen::Translation3d(0.0, y_m, 0.0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
}

MovedKeyframe keyframe(const recording::Trajectory& trajectory, int frame, const Eigen::Isometry3d& T_before_after) {
  const Eigen::Isometry3d& before = trajectory[static_cast<std::size_t>(frame)].T_map_camera;
  return {frame, before, before * T_before_after};
}

TEST(CarriedFrames, StayWhereNoKeyframeMoves) {
  const recording::Trajectory before = straight(7);
  const recording::Trajectory after = carryAlong(before, {keyframe(before, 2, moved(0.0, 0.0)), keyframe(before, 5, moved(0.0, 0.0))});
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT(geometry::logSe3(before[i].T_map_camera.inverse() * after[i].T_map_camera).norm(), 1e-12);
    EXPECT_EQ(after[i].stamp_ns, before[i].stamp_ns);
  }
}

TEST(CarriedFrames, MoveInProportionToTimeBetweenKeyframesAndWithTheNearestBeyond) {
  const recording::Trajectory before = straight(9);
  const recording::Trajectory after = carryAlong(before, {keyframe(before, 2, moved(0.0, 0.0)), keyframe(before, 6, moved(0.4, 0.0))});
  const std::vector<double> expected_y_m = {0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 0.4, 0.4};
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].T_map_camera.translation().y(), expected_y_m[i], 1e-9) << i;
    EXPECT_NEAR(after[i].T_map_camera.translation().x(), 0.1 * static_cast<double>(i), 1e-9) << i;
  }
}

TEST(CarriedFrames, TurnWithTheirKeyframe) {
  const recording::Trajectory before = straight(3);
  const MovedKeyframe first = keyframe(before, 0, moved(0.0, 0.5));
  const recording::Trajectory after = carryAlong(before, {first});
  const Eigen::Isometry3d expected = first.T_map_after * first.T_map_before.inverse() * before[2].T_map_camera;
  EXPECT_LT(geometry::logSe3(expected.inverse() * after[2].T_map_camera).norm(), 1e-12);
  EXPECT_GT(after[2].T_map_camera.translation().y(), 0.05);
}

/// Two drives whose stamps are the same.
TEST(CarriedFrames, StampsThatDoNotRiseMoveWithTheKeyframeBefore) {
  recording::Trajectory before = straight(4);
  before[2].stamp_ns = before[0].stamp_ns;
  before[3].stamp_ns = before[1].stamp_ns;
  const recording::Trajectory after = carryAlong(before, {keyframe(before, 0, moved(0.2, 0.0)), keyframe(before, 2, moved(0.6, 0.0))});
  EXPECT_NEAR(after[1].T_map_camera.translation().y(), 0.2, 1e-9);
  EXPECT_NEAR(after[3].T_map_camera.translation().y(), 0.6, 1e-9);
}

}  // namespace
}  // namespace oikos::mapping
