// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_alignment.h"

#include <gtest/gtest.h>

#include "tests/mapping/floorplan/seen_rooms.h"

namespace oikos::mapping {
namespace {

TEST(PlanAlignment, CleanWallsComeBackExactlyFromAGridOfStarts) {
  const FloorPlan plan = test::planOf(test::flat());
  const LineGrid grid(plan, kPlanReach_m);
  const Eigen::Isometry2d truth = test::placed(2.0, 0.8, 0.7);
  const WallSketch sketch = test::seen(test::flat(), truth);
  for (const double x_m : {-0.3, 0.0, 0.3}) {
    for (const double y_m : {-0.3, 0.0, 0.3}) {
      for (const double yaw_rad : {-0.1, 0.0, 0.1}) {
        const PlanAlignment result = alignToPlan(sketch, grid, truth * test::placed(x_m, y_m, yaw_rad), 1);
        ASSERT_EQ(result.status, PlanAlignmentStatus::kAligned) << x_m << " " << y_m << " " << yaw_rad;
        EXPECT_LT(test::errorOf(result.T_plan_level, truth).distance_m, 1e-6);
        EXPECT_LT(test::errorOf(result.T_plan_level, truth).turn_rad, 1e-6);
        EXPECT_LT(result.rms_m, 1e-6);
        EXPECT_EQ(result.pairs, static_cast<int>(sketch.walls.size()));
      }
    }
  }
}

TEST(PlanAlignment, FurnitureBeforeAWallDoesNotDrawTheMapToIt) {
  const FloorPlan plan = test::planOf(test::flat());
  const Eigen::Isometry2d truth = test::placed(2.0, 0.8, 0.7);
  WallSketch sketch = test::seen(test::flat(), truth);
  // Half of the walls of one direction stand 30 cm into their rooms.
  for (std::size_t i = 0; i < sketch.walls.size(); ++i) {
    const Eigen::Vector2d normal_plan = truth.linear() * sketch.walls[i].normal_level;
    if (i % 2 == 0 && normal_plan.y() > 0.9) {
      sketch.walls[i].point_level += 0.3 * sketch.walls[i].normal_level;
    }
  }
  const PlanAlignment result = alignToPlan(sketch, LineGrid(plan, kPlanReach_m), truth, 1);
  EXPECT_EQ(result.status, PlanAlignmentStatus::kAligned);
  EXPECT_LT(test::errorOf(result.T_plan_level, truth).distance_m, 1e-6);
}

TEST(PlanAlignment, WallsOfOneDirectionAreDegenerateAlongIt) {
  const FloorPlan plan = test::planOf(test::flat());
  const Eigen::Isometry2d truth = test::placed(2.0, 0.8, 0.7);
  WallSketch sketch = test::seen(test::flat(), truth);
  std::erase_if(sketch.walls, [&](const WallPoint& wall) { return std::abs((truth.linear() * wall.normal_level).x()) > 0.5; });
  const PlanAlignment result = alignToPlan(sketch, LineGrid(plan, kPlanReach_m), truth, 1);
  EXPECT_EQ(result.status, PlanAlignmentStatus::kDegenerate);
  EXPECT_NEAR(std::abs(result.open_plan.x()), 1.0, 1e-9);
}

TEST(PlanAlignment, FarFromEveryLineThereAreTooFewPairs) {
  const FloorPlan plan = test::planOf(test::flat());
  const WallSketch sketch = test::seen(test::flat(), test::placed(0.0, 0.0, 0.0));
  const PlanAlignment result = alignToPlan(sketch, LineGrid(plan, kPlanReach_m), test::placed(50.0, 0.0, 0.0), 1);
  EXPECT_EQ(result.status, PlanAlignmentStatus::kTooFewPairs);
  EXPECT_EQ(result.pairs, 0);
  EXPECT_DOUBLE_EQ(result.T_plan_level.translation().x(), 50.0) << "the last accepted estimate is the start";
  EXPECT_EQ(alignToPlan({}, LineGrid(plan, kPlanReach_m), test::placed(0.0, 0.0, 0.0), 1).status, PlanAlignmentStatus::kTooFewPairs);
  EXPECT_EQ(alignToPlan(sketch, LineGrid({}, kPlanReach_m), test::placed(0.0, 0.0, 0.0), 1).status, PlanAlignmentStatus::kTooFewPairs);
}

// Walls 12 cm thick have a line on each side: a plan that knows its rooms pairs each surface with its own.
TEST(LineGrid, ASurfaceIsPairedWithTheSideThatFacesIt) {
  const FloorPlan plan = test::planOf(test::flat());
  const LineGrid grid(plan, kPlanReach_m);
  const Eigen::Vector2d in_the_wall(1.0, 1.65);
  const auto from_hall = grid.findNearest(in_the_wall, {0.0, -1.0}, 0.3);
  const auto from_room = grid.findNearest(in_the_wall, {0.0, 1.0}, 0.3);
  ASSERT_TRUE(from_hall && from_room);
  EXPECT_NEAR(std::abs(from_hall->distance_m), 0.05, 1e-12);
  EXPECT_NEAR(std::abs(from_room->distance_m), 0.07, 1e-12);
  EXPECT_FALSE(grid.findNearest(in_the_wall, {1.0, 0.0}, 0.3)) << "no line runs across it";
  EXPECT_FALSE(grid.findNearest(in_the_wall, {0.0, -1.0}, 0.04)) << "none is so near";
}

}  // namespace
}  // namespace oikos::mapping
