// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/sanitary.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/model/furniture/furniture.h"
#include "tests/core/model/furniture/furniture_checks.h"

namespace oikos::model {
namespace {

using test::boundsAt;
using test::expectNear;

TEST(SinkUnit, ItsBasinIsOpenAndItsDoorsStayClear) {
  SinkUnitShape shape = {.width_m = 0.9, .depth_m = 0.6, .height_m = 0.88, .tap_height_m = 0.3};
  ArticulatedModel model = makeSinkUnit(shape);
  test::expectSound(model);
  test::expectNoCollision(model);
  expectNear(boundsAt(model, {0.0, 0.0}).min(), {-0.3, -0.45, 0.0}, 1e-6);
  expectNear(boundsAt(model, {0.0, 0.0}).max(), {0.336, 0.45, 0.88 + 0.3}, 1e-6);
  expectNear(boundsAt(model, {0.0, 0.0}, "basin").sizes(), {0.36, 0.5, 0.18}, 1e-6);
  const Eigen::Vector3d in_the_basin(0.3 - 0.09 - 0.18, 0.0, 0.88 - 0.1);
  for (const Eigen::AlignedBox3d& box : test::boxesOf(*model.parts[0].mesh_part)) {
    EXPECT_FALSE(box.contains(in_the_basin));
  }
}

TEST(Toilet, ItsLidStandsUprightBeforeTheCistern) {
  const ToiletShape shape = {
      .width_m = 0.38, .depth_m = 0.7, .height_m = 0.82, .seat_height_m = 0.44, .cistern_depth_m = 0.18, .lid_m = 0.02};
  const ArticulatedModel model = makeToilet(shape);
  test::expectSound(model);
  test::expectNoCollision(model);
  expectNear(boundsAt(model, {0.0}).min(), {-0.35, -0.19, 0.0}, 1e-6);
  expectNear(boundsAt(model, {0.0}).max(), {0.35, 0.19, 0.82}, 1e-6);
  EXPECT_NEAR(boundsAt(model, {0.0}, "lid").max().z(), 0.44, 1e-6);
  const Eigen::AlignedBox3d open = boundsAt(model, {std::numbers::pi / 2.0}, "lid");
  const double hinge_x = -0.35 + 0.18 + 0.02 + 0.01;
  EXPECT_NEAR(open.min().x(), hinge_x - 0.02, 1e-6);
  EXPECT_NEAR(open.max().x(), hinge_x, 1e-6);
  EXPECT_NEAR(open.max().z(), 0.42 + 0.35 - hinge_x, 1e-6);
}

TEST(Bathtub, HoldsWhatItsInsideMeasures) {
  const BathtubShape shape = {.width_m = 1.6, .depth_m = 0.7, .height_m = 0.55, .rim_m = 0.05, .bottom_m = 0.1, .tap_height_m = 0.0};
  const ArticulatedModel model = makeBathtub(shape);
  test::expectSound(model);
  EXPECT_NEAR(test::volumeM3(*model.parts[0].mesh_part), 1.6 * 0.7 * 0.55 - 1.5 * 0.6 * 0.45, 1e-6);
  expectNear(boundsAt(model, {}).max(), {0.35, 0.8, 0.55}, 1e-6);
}

TEST(Washbasin, StandsOnItsPedestalBelowItsTap) {
  const ArticulatedModel model = makeWashbasin({.width_m = 0.6, .depth_m = 0.5, .height_m = 0.85, .tap_height_m = 0.1});
  test::expectSound(model);
  expectNear(boundsAt(model, {}).min(), {-0.25, -0.3, 0.0}, 1e-6);
  expectNear(boundsAt(model, {}).max(), {0.25, 0.3, 0.95}, 1e-6);
}

TEST(Sanitary, SaysWhatIsWrong) {
  EXPECT_EQ(SinkUnitShape{.basin_width_m = 0.9}.validate().front(), "furniture.basin_width_m = 0.9: must fit between the sides");
  EXPECT_EQ(ToiletShape{.seat_height_m = 1.0}.validate().front(), "furniture.seat_height_m = 1: must be less than height_m");
  EXPECT_EQ(BathtubShape{.rim_m = 0.5}.validate().front(), "furniture.rim_m = 0.5: must leave room inside");
  EXPECT_EQ(WashbasinShape{.depth_m = 0.1}.validate().front(), "furniture.shelf_m = 0.09: must leave room for the basin before it");
}

}  // namespace
}  // namespace oikos::model
