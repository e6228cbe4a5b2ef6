// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/relations.h"

#include <gtest/gtest.h>

namespace oikos::semantic {
namespace {

const Box kTableTop{{.position_m = {0.0, 0.0, 0.735}}, {1.2, 0.8, 0.03}};
const Box kCupboard{{.position_m = {0.0, 0.0, 0.9}}, {0.5, 1.0, 1.8}};
const Box kCup{{.position_m = {0.0, 0.0, 0.05}}, {0.08, 0.08, 0.1}};

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(Relations, OnInUnderBeside) {
  EXPECT_EQ(findRelation(kTableTop, at(0.3, 0.1, 0.75), kCup), Relation::kOn);
  EXPECT_EQ(findRelation(kTableTop, at(0.3, 0.1, 0.0), kCup), Relation::kUnder);
  EXPECT_EQ(findRelation(kTableTop, at(0.7, 0.1, 0.75), kCup), std::nullopt);  // beside the top's edge
  EXPECT_EQ(findRelation(kTableTop, at(0.3, -0.41, 0.75), kCup), std::nullopt);
  EXPECT_EQ(findRelation(kTableTop, at(0.3, 0.1, 1.2), kCup), std::nullopt);  // in the air
  EXPECT_EQ(findRelation(kCupboard, at(0.0, 0.2, 0.8), kCup), Relation::kIn);
  EXPECT_EQ(findRelation(kCupboard, at(0.0, 0.2, 1.8), kCup), Relation::kOn);
}

TEST(Relations, TouchIsJudgedAtTheFoot) {
  EXPECT_EQ(findRelation(kTableTop, at(0.0, 0.0, 0.75 + kTouch_m - 0.001), kCup), Relation::kOn);
  EXPECT_EQ(findRelation(kTableTop, at(0.0, 0.0, 0.75 + kTouch_m + 0.001), kCup), std::nullopt);
  EXPECT_EQ(findRelation(kTableTop, at(0.0, 0.0, 0.75), std::nullopt), Relation::kOn);  // without a box: its origin is its foot
}

TEST(Relations, ATurnedCarrierIsSeenFromItsOwnAxes) {
  const Box turned{{{1.0, 0.0, 0.5}, {0.0, 0.0, 3.14159265358979 / 2.0}}, {1.0, 0.2, 1.0}};  // long along y
  EXPECT_EQ(findRelation(turned, at(1.0, 0.4, 1.0), kCup), Relation::kOn);
  EXPECT_EQ(findRelation(turned, at(1.4, 0.0, 1.0), kCup), std::nullopt);
}

TEST(Relations, DistanceToABox) {
  EXPECT_DOUBLE_EQ(distanceTo(kCupboard, {0.1, 0.2, 0.9}), 0.0);
  EXPECT_NEAR(distanceTo(kCupboard, {0.25 + 0.3, 0.5 + 0.4, 0.9}), 0.5, 1e-12);
  const Box turned{{{1.0, 0.0, 0.5}, {0.0, 0.0, 3.14159265358979 / 2.0}}, {1.0, 0.2, 1.0}};
  EXPECT_NEAR(distanceTo(turned, {1.0, 0.7, 0.5}), 0.2, 1e-12);
}

TEST(Relations, ToSeveralBoxesAtOnce) {
  using enum SpatialRelation;
  const std::vector<Box> boxes{kTableTop, kCupboard};
  const auto relations = [&](double x, double y, double z) { return spatialRelations(boxes, at(x, y, z), kCup); };
  EXPECT_EQ(relations(0.0, 0.0, 0.75), (std::vector{kOn, kIn}));
  EXPECT_EQ(relations(0.0, 0.0, 0.2), (std::vector{kIn, kUnder}));
  EXPECT_EQ(relations(0.6 + 0.4, 0.0, 0.7), std::vector{kNear});
  EXPECT_EQ(relations(0.6 + 0.6, 0.0, 0.7), std::vector<SpatialRelation>{});
  EXPECT_EQ(spatialRelations({}, at(0.0, 0.0, 0.0), kCup), std::vector<SpatialRelation>{});
}

TEST(Relations, BoxesOfAnObjectIncludeItsPartsWhereTheirJointsHoldThem) {
  LargeObject chest;
  chest.id = {"chest"};
  chest.boxes_object = {kCupboard};
  Part body{{"body"}, "", {""}, "", {}, {}};
  Part drawer{{"drawer"}, "", {"body"}, "", {Box{{}, {0.4, 0.4, 0.2}}}, {}};
  Joint slide;
  slide.type = JointType::kPrismatic;
  slide.parent = body.id;
  slide.child = drawer.id;
  slide.axis_joint = Eigen::Vector3d::UnitX();
  slide.value = 0.25;
  chest.articulation = Articulation{{body, drawer}, {slide}, {}, {}};
  const std::vector<Box> all = boxesOf(chest, "chest");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[1].center.position_m.x(), 0.25, 1e-12);
  const std::vector<Box> own = boxesOf(chest, "drawer");
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0].center.position_m.x(), 0.0);
  EXPECT_TRUE(boxesOf(chest, "body").empty());
}

}  // namespace
}  // namespace oikos::semantic
