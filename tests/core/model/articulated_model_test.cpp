// SPDX-License-Identifier: Apache-2.0
#include "core/model/articulated_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/se3.h"
#include "core/model/primitives.h"
#include "tests/support/expect_error.h"

namespace oikos::model {
namespace {

/// A body with a door that carries a drawer; the joints stand in the wrong order on purpose.
ArticulatedModel makeCupboard() {
  ArticulatedModel model;
  model.name = "cupboard";
  const auto box = std::make_shared<const TriangleMesh>(makeBox({1.0F, 1.0F, 1.0F}));
  model.parts = {{"drawer", box}, {"body", box}, {"door", box}};
  ModelJoint slide{.name = "slide", .type = MotionType::kPrismatic, .parent = 2, .child = 0, .upper = 0.4};
  slide.axis_joint = Eigen::Vector3d::UnitX();
  ModelJoint hinge{.name = "hinge", .type = MotionType::kRevolute, .parent = 1, .child = 2, .upper = 2.0};
  hinge.T_parent_joint.translation() << 1.0, 2.0, 3.0;
  model.joints = {slide, hinge};
  return model;
}

void expectInvalid(const ArticulatedModel& model, const std::string& part) {
  test::expectError(base::ErrorCode::kInput, {model.name, part}, [&] { const Kinematics kinematics(model); });
}

TEST(Kinematics, AQuarterTurnOfTheDoorTakesTheDrawerAlong) {
  const Kinematics kinematics(makeCupboard());
  const auto T_model_part = kinematics.solve({0.3, std::numbers::pi / 2.0});
  EXPECT_EQ(kinematics.root(), 1);
  EXPECT_TRUE(T_model_part[1].matrix().isIdentity(1e-12));
  EXPECT_NEAR((T_model_part[2].translation() - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((T_model_part[0].translation() - Eigen::Vector3d(1.0, 2.3, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((T_model_part[0].linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

TEST(Kinematics, ALongChainIsTheProductOfItsMotions) {
  ArticulatedModel model;
  Eigen::Isometry3d T_model_last = Eigen::Isometry3d::Identity();
  std::vector<double> values;
  model.parts.push_back({"0", nullptr});
  for (int i = 1; i < 1000; ++i) {
    model.parts.push_back({std::to_string(i), nullptr});
    ModelJoint joint{.name = std::to_string(i), .type = MotionType::kRevolute, .parent = i - 1, .child = i, .upper = 1.0};
    joint.axis_joint = Eigen::Vector3d(std::sin(i), std::cos(i), 0.5).normalized();
    joint.T_parent_joint.translation() << 0.01, 0.0, 0.02;
    model.joints.push_back(joint);
    values.push_back(0.001 * i);
    geometry::Vector6d turn = geometry::Vector6d::Zero();
    turn.tail<3>() = joint.axis_joint * values.back();
    T_model_last = T_model_last * joint.T_parent_joint * geometry::expSe3(turn);
  }
  const auto T_model_part = Kinematics(model).solve(values);
  EXPECT_TRUE(T_model_part.back().matrix().isApprox(T_model_last.matrix(), 1e-9));
}

TEST(Kinematics, RefusesWhatIsNoTree) {
  ArticulatedModel two_roots = makeCupboard();
  two_roots.joints.pop_back();
  expectInvalid(two_roots, "two roots");
  ArticulatedModel circle = makeCupboard();
  circle.joints.push_back({.name = "back", .parent = 0, .child = 1});
  expectInvalid(circle, "circle");
  ArticulatedModel island = makeCupboard();
  island.joints[1].parent = 0;
  expectInvalid(island, "circle");
  ArticulatedModel two_parents = makeCupboard();
  two_parents.joints.push_back({.name = "again", .parent = 1, .child = 0});
  expectInvalid(two_parents, "two joints");
  expectInvalid(ArticulatedModel{}, "no part");
}

TEST(Kinematics, RefusesWrongNumbers) {
  ArticulatedModel axis = makeCupboard();
  axis.joints[0].axis_joint *= 2.0;
  expectInvalid(axis, "axis of length 2");
  ArticulatedModel limits = makeCupboard();
  limits.joints[0].lower = 1.0;
  expectInvalid(limits, "limits");
  ArticulatedModel origin = makeCupboard();
  origin.joints[0].T_parent_joint.linear() *= 1.1;
  expectInvalid(origin, "rigid");
  ArticulatedModel index = makeCupboard();
  index.joints[0].child = 3;
  expectInvalid(index, "part 3");
  ArticulatedModel handle = makeCupboard();
  handle.handles.push_back({.name = "bar", .part = -1, .T_part_handle = Eigen::Isometry3d::Identity(), .length_m = {}});
  expectInvalid(handle, "handle 'bar'");
}

TEST(Kinematics, AJointMayHaveNoLimits) {
  ArticulatedModel model = makeCupboard();
  model.joints[1].lower = -std::numeric_limits<double>::infinity();
  model.joints[1].upper = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Kinematics(model).jointCount(), 2);
}

}  // namespace
}  // namespace oikos::model
