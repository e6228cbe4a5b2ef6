// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/seen_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const Eigen::Vector3d kTarget(1.0, 0.0, 1.0);  ///< in the air of a bare room

/// Looks through the target from 1.5 m before it, from directions that many degrees apart in turn.
SeenSpace lookedThrough(int views, double step_deg) {
  const test::AnalyticRoom room({{-3.0, -3.0, 0.0}, {3.0, 3.0, 2.5}, {200, 200, 200}}, {});
  SeenSpace space({}, {}, 1);
  for (int i = 0; i < views; ++i) {
    const double yaw = i % 2 * step_deg * kDegree;
    const Eigen::Vector3d eye = kTarget - 1.5 * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0.0);
    const Eigen::Isometry3d T_map_camera = test::lookAt(eye, kTarget);
    const camera::RgbdFrame frame = room.render(test::smallCamera(), T_map_camera);
    space.insert({frame, test::smallCamera(), T_map_camera});
  }
  return space;
}

SpaceState stateAt(const SeenSpace& space, const Eigen::Vector3d& point_map) {
  return space.state(*space.lattice().findKey(point_map.cast<float>()));
}

TEST(SeenSpace, IsFreeWhenSeenRepeatedlyFromViewsApart) {
  EXPECT_EQ(stateAt(lookedThrough(3, 20.0), kTarget), SpaceState::kFree);
}

TEST(SeenSpace, IsNotFreeFromTooFewViews) {
  EXPECT_EQ(stateAt(lookedThrough(2, 20.0), kTarget), SpaceState::kUncertain);
}

TEST(SeenSpace, IsNotFreeFromOneSideOnly) {
  EXPECT_EQ(stateAt(lookedThrough(10, 10.0), kTarget), SpaceState::kUncertain);
}

TEST(SeenSpace, KnowsWallsAndWhatNobodySaw) {
  const SeenSpace space = lookedThrough(3, 20.0);
  EXPECT_EQ(stateAt(space, {3.001, 0.0, 1.0}), SpaceState::kOccupied);
  EXPECT_EQ(stateAt(space, {3.5, 0.0, 1.0}), SpaceState::kUnknown);
  EXPECT_EQ(stateAt(space, {-2.0, 0.0, 1.0}), SpaceState::kUnknown);  // behind the camera
}

TEST(SeenSpace, RefusesBrokenConfigurations) {
  EXPECT_THROW(SeenSpace({}, {.min_views = 0}, 1), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::mapping
