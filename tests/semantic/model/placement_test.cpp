// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/placement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oikos::semantic {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A body, a drawer in it that slides along y, and a lid on the drawer that turns about the drawer's z.
Articulation chest(double drawn_m, double turned_rad) {
  Articulation chest;
  chest.parts = {{{"body"}, "", {""}, "", {}, {}}, {{"drawer"}, "", {"body"}, "", {}, {}}, {{"lid"}, "", {"drawer"}, "", {}, {}}};
  Joint slide;
  slide.id = {"slide"};
  slide.type = JointType::kPrismatic;
  slide.parent = {"body"};
  slide.child = {"drawer"};
  slide.T_parent_joint.position_m = {0.0, 0.0, 0.5};
  slide.axis_joint = {0.0, 1.0, 0.0};
  slide.value = drawn_m;
  Joint hinge;
  hinge.id = {"hinge"};
  hinge.parent = {"drawer"};
  hinge.child = {"lid"};
  hinge.T_parent_joint = {{0.2, 0.0, 0.1}, {0.0, 0.0, kPi / 2.0}};
  hinge.value = turned_rad;
  chest.joints = {slide, hinge};
  return chest;
}

TEST(Placement, PoseTurnsAboutXThenYThenZ) {
  const Pose pose{{1.0, 2.0, 3.0}, {kPi / 2.0, 0.0, kPi / 2.0}};
  const Eigen::Vector3d p = pose.toIsometry() * Eigen::Vector3d(0.0, 1.0, 0.0);
  EXPECT_LT((p - Eigen::Vector3d(1.0, 2.0, 4.0)).norm(), 1e-12) << p.transpose();  // y to z by roll; yaw leaves z
  const Eigen::Vector3d q = pose.toIsometry() * Eigen::Vector3d(1.0, 0.0, 0.0);
  EXPECT_LT((q - Eigen::Vector3d(1.0, 3.0, 3.0)).norm(), 1e-12) << q.transpose();
}

TEST(Placement, PartsFollowTheirJoints) {
  const auto T_object_lid = findPartInObject(chest(0.3, kPi / 2.0), {"lid"});
  ASSERT_TRUE(T_object_lid);
  EXPECT_LT((T_object_lid->translation() - Eigen::Vector3d(0.2, 0.3, 0.6)).norm(), 1e-12);
  const Eigen::Vector3d x_axis = T_object_lid->linear().col(0);  // turned by 90 + 90 degrees
  EXPECT_LT((x_axis - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-12);
}

TEST(Placement, AnAxisOfAnyLengthMovesByTheValue) {
  Articulation articulation = chest(0.3, 0.0);
  articulation.joints[0].axis_joint *= 7.0;
  EXPECT_NEAR(findPartInObject(articulation, {"drawer"})->translation().y(), 0.3, 1e-12);
}

TEST(Placement, APartThatNoJointMovesIsFixedToItsParent) {
  Articulation articulation = chest(0.3, 0.0);
  articulation.joints.resize(1);
  EXPECT_TRUE(findPartInObject(articulation, {"lid"})->isApprox(*findPartInObject(articulation, {"drawer"}), 1e-12));
}

TEST(Placement, NoSuchPartAndACircleAreNothing) {
  Articulation articulation = chest(0.3, 0.0);
  EXPECT_FALSE(findPartInObject(articulation, {"door"}));
  articulation.parts[0].parent = {"lid"};
  EXPECT_FALSE(findPartInObject(articulation, {"lid"}));
}

TEST(Placement, ACupInADrawerMovesWithTheDrawer) {
  LargeObject object;
  object.id = {"chest"};
  object.T_map_object = {{5.0, 1.0, 0.0}, {0.0, 0.0, kPi}};
  object.articulation = chest(0.0, 0.0);
  const Pose T_drawer_cup{.position_m = {0.1, 0.0, 0.02}};
  const Eigen::Vector3d shut_map = (*findCarrierInMap(object, "drawer") * T_drawer_cup.toIsometry()).translation();
  object.articulation->joints[0].value = 0.4;
  const Eigen::Vector3d open_map = (*findCarrierInMap(object, "drawer") * T_drawer_cup.toIsometry()).translation();
  EXPECT_LT((shut_map - Eigen::Vector3d(4.9, 1.0, 0.52)).norm(), 1e-12);
  EXPECT_LT((open_map - shut_map - Eigen::Vector3d(0.0, -0.4, 0.0)).norm(), 1e-12);
  EXPECT_TRUE(findCarrierInMap(object, "chest")->isApprox(object.T_map_object.toIsometry(), 1e-12));
  EXPECT_FALSE(findCarrierInMap(object, "sofa"));
}

}  // namespace
}  // namespace oikos::semantic
