// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_fit.h"

#include <gtest/gtest.h>

#include <numbers>

#include "mapping/floorplan/plan_task.h"
#include "tests/mapping/floorplan/seen_rooms.h"
#include "tests/support/enum_table_check.h"
#include "tests/support/expect_error.h"

namespace oikos::mapping {
namespace {

using test::flat;
using test::placed;
using test::planOf;
using test::Rooms;
using test::seen;

Eigen::AlignedBox2d box(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

const Eigen::Isometry2d kStart = placed(2.0, 0.8, 0.7);

Rooms moved(Rooms rooms, std::size_t which, const Eigen::Vector2d& by) {
  rooms[which].translate(by);
  return rooms;
}

Rooms scaled(Rooms rooms, double scale) {
  for (Eigen::AlignedBox2d& room : rooms) {
    room = {scale * room.min(), scale * room.max()};
  }
  return rooms;
}

TEST(PlanFit, IsFoundFromEveryStart) {
  const FloorPlan plan = planOf(flat());
  for (int i = 0; i < 12; ++i) {
    const Eigen::Isometry2d truth = placed(0.7 * i - 4.0, 3.0 - 0.5 * i, i * std::numbers::pi / 6.0 + 0.1);
    const PlanFit fit = fitToPlan(seen(flat(), truth), plan, {});
    ASSERT_EQ(fit.status, PlanFitStatus::kFitted) << fit.reason;
    EXPECT_LT(test::errorOf(fit.T_plan_level, truth).distance_m, 1e-5) << i;
    EXPECT_LT(test::errorOf(fit.T_plan_level, truth).turn_rad, 1e-5) << i;
    EXPECT_EQ(fit.reason, "");
    EXPECT_DOUBLE_EQ(fit.figures.on_plan_share, 1.0);
    EXPECT_GT(fit.figures.supported_share, 0.99);
    EXPECT_DOUBLE_EQ(fit.figures.crossed_m, 0.0);
    EXPECT_DOUBLE_EQ(fit.figures.missing_m, 0.0);
    EXPECT_DOUBLE_EQ(fit.figures.floor_outside_m2, 0.0);
    EXPECT_DOUBLE_EQ(fit.figures.beyond_share, 0.0);
    EXPECT_LT(fit.moved_room.gain_share, 0.01);
    EXPECT_DOUBLE_EQ(fit.better_scale, 1.0);
  }
}

TEST(PlanFit, DoorwaysThatThePlanDoesNotShowAreAllowed) {
  WallSketch sketch = seen(flat(), kStart);
  test::openDoor(box(1.0, 1.45, 1.9, 1.85), kStart, sketch);
  test::openDoor(box(3.0, -0.25, 4.0, 0.15), kStart, sketch);
  const PlanFit fit = fitToPlan(sketch, planOf(flat()), {});
  EXPECT_EQ(fit.status, PlanFitStatus::kFitted) << fit.reason;
  EXPECT_DOUBLE_EQ(fit.figures.crossed_m, 0.0);
}

TEST(PlanFit, AMapWithHardlyAWallIsRefused) {
  WallSketch sketch = seen(flat(), kStart);
  sketch.walls.resize(100);
  const PlanFit fit = fitToPlan(sketch, planOf(flat()), {});
  EXPECT_EQ(fit.status, PlanFitStatus::kTooFewWalls);
  EXPECT_EQ(fit.reason, "the drive saw 5.0 m of walls; at least 6.0 m are needed");
  EXPECT_EQ(fitToPlan({}, planOf(flat()), {}).status, PlanFitStatus::kTooFewWalls);
}

TEST(PlanFit, APlanWithoutLinesHasNoPlaceForAMap) {
  EXPECT_EQ(fitToPlan(seen(flat(), kStart), {}, {}).status, PlanFitStatus::kNoAlignment);
}

TEST(PlanFit, WallsOfOneDirectionLeaveTheOtherOpen) {
  WallSketch sketch = seen(flat(), kStart);
  std::erase_if(sketch.walls, [&](const WallPoint& wall) { return std::abs((kStart.linear() * wall.normal_level).x()) > 0.5; });
  EXPECT_EQ(fitToPlan(sketch, planOf(flat()), {}).status, PlanFitStatus::kOpenDirection);
}

TEST(PlanFit, AMirroredPlanIsRefused) {
  Rooms mirrored;
  for (const Eigen::AlignedBox2d& room : flat()) {
    mirrored.push_back(box(-room.max().x(), room.min().y(), -room.min().x(), room.max().y()));
  }
  const PlanFit fit = fitToPlan(seen(flat(), kStart), planOf(mirrored), {});
  EXPECT_NE(fit.status, PlanFitStatus::kFitted);
  EXPECT_NE(fit.reason, "");
}

TEST(PlanFit, AnotherHomesPlanIsRefusedForWhatIsNotDrawn) {
  const Rooms other = {box(0.0, 0.0, 5.0, 3.0), box(0.0, 3.12, 3.0, 9.0), box(5.12, -2.0, 8.0, 2.5)};
  const PlanFit fit = fitToPlan(seen(flat(), kStart), planOf(other), {});
  EXPECT_EQ(fit.status, PlanFitStatus::kOffPlan);
  EXPECT_NE(fit.reason.find("of the upright surface seen lie on the plan's walls; at least 50 % must"), std::string::npos) << fit.reason;
}

TEST(PlanFit, EachRoomThatIsMovedIsNoticedAndHowFar) {
  for (std::size_t room = 0; room < flat().size(); ++room) {
    for (const Eigen::Vector2d& by :
         {Eigen::Vector2d(0.6, 0.0), Eigen::Vector2d(-0.6, 0.0), Eigen::Vector2d(0.0, 0.6), Eigen::Vector2d(0.0, -0.6)}) {
      const PlanFit fit = fitToPlan(seen(flat(), kStart), planOf(moved(flat(), room, by)), {});
      EXPECT_NE(fit.status, PlanFitStatus::kFitted) << room << " by " << by.transpose();
      if (fit.status == PlanFitStatus::kMovedRoom) {
        EXPECT_NEAR(fit.moved_room.shift_plan.norm(), 0.6, 0.06);
      }
    }
  }
  EXPECT_EQ(fitToPlan(seen(flat(), kStart), planOf(moved(flat(), 2, {0.6, 0.0})), {}).status, PlanFitStatus::kMovedRoom);
}

TEST(PlanFit, APlanWithoutOneOfTheRoomsIsRefusedForTheFloorOutside) {
  for (std::size_t room = 1; room < flat().size(); ++room) {
    Rooms without = flat();
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(room));
    const PlanFit fit = fitToPlan(seen(flat(), kStart), planOf(without), {});
    EXPECT_EQ(fit.status, PlanFitStatus::kOutside) << room << ": " << fit.reason;
    EXPECT_NE(fit.reason.find("m2 of floor were seen where the plan has no room"), std::string::npos) << fit.reason;
  }
}

TEST(PlanFit, WallsBeyondThePlanAreNoticedWithoutFloor) {
  Rooms without = flat();
  without.pop_back();
  WallSketch sketch = seen(flat(), kStart);
  sketch.floor_level.clear();
  const PlanFit fit = fitToPlan(sketch, planOf(without), {});
  EXPECT_EQ(fit.status, PlanFitStatus::kOutside);
  EXPECT_NE(fit.reason.find("beyond the plan's outermost walls"), std::string::npos) << fit.reason;
}

TEST(PlanFit, AWallThatLeadsOverFloorIsNoticed) {
  FloorPlan plan = planOf(flat());
  plan.lines.push_back({{1.0, -2.0}, {6.0, -2.0}, {0.0, 1.0}, true, 99});
  const PlanFit fit = fitToPlan(seen(flat(), kStart), plan, {});
  EXPECT_EQ(fit.status, PlanFitStatus::kCrossed) << fit.reason;
  EXPECT_NEAR(fit.figures.crossed_m, 5.0 - 0.2 - 1.2, 0.15) << "but for the ends, which are over no floor, and a doorway";
}

TEST(PlanFit, AWallThatShouldHaveBeenSeenIsMissed) {
  // The far room ends 12 cm behind floor that was seen, but its wall is not there.
  WallSketch sketch = seen(flat(), kStart);
  std::erase_if(sketch.walls, [&](const WallPoint& wall) { return (kStart * wall.point_level).y() < -4.1; });
  const PlanFit fit = fitToPlan(sketch, planOf(flat()), {});
  EXPECT_EQ(fit.status, PlanFitStatus::kMissing) << fit.reason;
  EXPECT_NEAR(fit.figures.missing_m, 5.0 - 0.2 - 1.2, 0.25);
}

// A drawing does not tell which side of a line is the room. Behind a wall that furniture hides there is another room's floor.
TEST(PlanFit, FurnitureBeforeAWallOfADrawingIsNoMissingWall) {
  FloorPlan drawing = planOf(flat());
  for (PlanLine& line : drawing.lines) {
    line.inwards.setZero();
    line.room = 0;
  }
  numberRooms(drawing);
  WallSketch sketch = seen(flat(), kStart);
  const Eigen::AlignedBox2d cupboards = box(0.0, 1.7, 3.4, 2.3);
  std::erase_if(sketch.walls, [&](const WallPoint& wall) { return cupboards.contains(kStart * wall.point_level); });
  std::erase_if(sketch.floor_level, [&](const Eigen::Vector2d& cell) { return cupboards.contains(kStart * cell); });
  const PlanFit fit = fitToPlan(sketch, drawing, {});
  EXPECT_EQ(fit.status, PlanFitStatus::kFitted) << fit.reason;
  EXPECT_LT(test::errorOf(fit.T_plan_level, kStart).distance_m, 1e-5);
  EXPECT_DOUBLE_EQ(fit.figures.missing_m, 0.0);
}

TEST(PlanFit, AWrongScaleIsNamed) {
  const Rooms one = {box(0.0, 0.0, 5.0, 3.0), box(0.0, 3.12, 2.0, 6.0)};
  PlanFitConfig lenient;
  lenient.min_on_plan_share = 0.1;
  lenient.max_crossed_m = 100.0;
  lenient.max_missing_m = 100.0;
  lenient.max_floor_outside_m2 = 100.0;
  lenient.max_beyond_share = 1.0;
  lenient.max_rms_m = 1.0;
  lenient.max_moved_share = 1.0;
  lenient.min_supported_share = 0.0;
  const PlanFit fit = fitToPlan(seen(one, kStart), planOf(scaled(one, 1.1)), lenient);
  EXPECT_EQ(fit.status, PlanFitStatus::kWrongScale) << fit.reason;
  EXPECT_NEAR(fit.better_scale, 1.0 / 1.1, 0.01);
  EXPECT_NE(fitToPlan(seen(flat(), kStart), planOf(scaled(flat(), 0.95)), {}).status, PlanFitStatus::kFitted);
  EXPECT_NE(fitToPlan(seen(flat(), kStart), planOf(scaled(flat(), 1.05)), {}).status, PlanFitStatus::kFitted);
}

TEST(PlanFit, WallsThatLieLooselyAreRefused) {
  WallSketch sketch = seen(flat(), kStart);
  for (std::size_t i = 0; i < sketch.walls.size(); ++i) {
    sketch.walls[i].point_level += (i % 2 == 0 ? 0.06 : -0.06) * sketch.walls[i].normal_level;
  }
  EXPECT_EQ(fitToPlan(sketch, planOf(flat()), {}).status, PlanFitStatus::kLoose);
}

TEST(PlanFit, ADriveThroughOneRoomIsTooLittleUnlessItBeganWhereExpected) {
  const Eigen::Isometry2d truth = placed(3.0, -2.0, 0.3);
  const WallSketch sketch = seen({flat()[3]}, truth);
  const PlanFit unknown = fitToPlan(sketch, planOf(flat()), {});
  EXPECT_EQ(unknown.status, PlanFitStatus::kTooLittle) << unknown.reason;
  const PlanFit known = fitToPlan(sketch, planOf(flat()), {}, placed(3.2, -2.1, 0.4));
  EXPECT_EQ(known.status, PlanFitStatus::kFitted) << known.reason;
  EXPECT_LT(test::errorOf(known.T_plan_level, truth).distance_m, 1e-5);
}

TEST(PlanFit, ASymmetricalHomeIsAmbiguousUnlessItIsKnownWhereTheDriveBegan) {
  const Rooms corridor = {box(0.0, 0.0, 8.0, 1.6)};
  const Eigen::Isometry2d truth = placed(1.0, 0.8, 0.0);
  const PlanFit unknown = fitToPlan(seen(corridor, truth), planOf(corridor), {});
  EXPECT_EQ(unknown.status, PlanFitStatus::kAmbiguous);
  EXPECT_NE(unknown.reason.find("another place on the plan"), std::string::npos) << unknown.reason;
  EXPECT_GT(unknown.runner_up, 0.95);
  const PlanFit known = fitToPlan(seen(corridor, truth), planOf(corridor), {}, placed(1.3, 0.7, 0.2));
  EXPECT_EQ(known.status, PlanFitStatus::kFitted);
  EXPECT_LT(test::errorOf(known.T_plan_level, truth).distance_m, 1e-5);
  const PlanFit opposite = fitToPlan(seen(corridor, truth), planOf(corridor), {}, placed(7.0, 0.8, std::numbers::pi));
  EXPECT_EQ(opposite.status, PlanFitStatus::kFitted);
  EXPECT_LT(test::errorOf(opposite.T_plan_level, placed(7.0, 0.8, std::numbers::pi)).distance_m, 1e-5);
}

TEST(PlanFit, AWrongExpectationDoesNotMoveAClearFit) {
  const PlanFit fit = fitToPlan(seen(flat(), kStart), planOf(flat()), {}, placed(5.0, 3.0, -2.0));
  EXPECT_EQ(fit.status, PlanFitStatus::kFitted);
  EXPECT_LT(test::errorOf(fit.T_plan_level, kStart).distance_m, 1e-5);
}

TEST(PlanFit, StatusNamesRoundTrip) {
  oikos::test::checkEnumTable(PlanFitStatus::kFitted);
}

// A drawing's axes, with the dock where the drive began at the origin (S57); or a home's own frame.
TEST(PlacePlan, TheMapsFrameIsTheDocksOrThePlans) {
  const WallSketch sketch = seen(flat(), kStart);
  const PlanPlacement dock = placeOnPlan(sketch, {planOf(flat()), "flat.svg", PlanFrame::kDock}, {});
  EXPECT_LT(test::errorOf(dock.T_map_base, placed(0.0, 0.0, 0.7)).distance_m, 1e-9);
  EXPECT_LT(test::errorOf(dock.T_map_base, placed(0.0, 0.0, 0.7)).turn_rad, 1e-5);
  EXPECT_LT(test::errorOf(dock.T_plan_map, placed(2.0, 0.8, 0.0)).distance_m, 1e-5);
  EXPECT_LT(test::errorOf(dock.T_plan_map, placed(2.0, 0.8, 0.0)).turn_rad, 1e-12) << "the map's axes are the plan's";
  const PlanPlacement home = placeOnPlan(sketch, {planOf(flat()), "home.xml", PlanFrame::kPlan}, {});
  EXPECT_LT(test::errorOf(home.T_map_base, kStart).distance_m, 1e-5);
  EXPECT_TRUE(home.T_plan_map.isApprox(Eigen::Isometry2d::Identity()));
}

TEST(PlacePlan, APlanThatDoesNotFitIsNamedWithTheFigure) {
  Rooms without = flat();
  without.pop_back();
  oikos::test::expectError(base::ErrorCode::kInput, {"flat.svg", "the map does not fit", "m2 of floor"}, [&] {
    static_cast<void>(placeOnPlan(seen(flat(), kStart), {planOf(without), "flat.svg"}, {}));
  });
}

}  // namespace
}  // namespace oikos::mapping
