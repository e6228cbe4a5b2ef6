// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/knob.h"

#include <gtest/gtest.h>

#include "core/model/furniture/appliances.h"
#include "core/model/primitives.h"
#include "tests/support/expect_error.h"

namespace oikos::recognition {
namespace {

TEST(Knob, OfAnOvenIsDescribedOnItsPanel) {
  const model::OvenShape shape;
  const model::ArticulatedModel oven = model::makeOven(shape);
  const KnobDescription knob = describeKnob(oven, 2);
  EXPECT_EQ(knob.name, oven.knobs[2].name);
  EXPECT_EQ(knob.states.size(), 10U);
  EXPECT_NEAR(knob.T_part_knob.translation().x(), shape.depth_m / 2.0, 1e-9);  // on the face
  EXPECT_NEAR(knob.T_part_knob.translation().y(), 0.0, 1e-9);                  // the middle one of five
  const KnobFace face = findFace(knob);
  EXPECT_NEAR(face.radius_m, 1.06 * shape.knob_radius_m, 5e-4);  // to the end of its mark
  EXPECT_EQ(face.turn_sign, -1.0);                               // it turns clockwise
  EXPECT_NEAR((face.T_knob_face.linear() * Eigen::Vector3d::UnitZ()).x(), 1.0, 1e-9);
  EXPECT_NEAR(face.T_knob_face.translation().x(), face.height_m, 1e-9);
}

TEST(Knob, AnAxisTowardsTheViewerTurnsCounterClockwise) {
  model::TriangleMesh mesh = model::makeBoxBetween({Eigen::Vector3f(-0.02F, -0.01F, 0.0F), Eigen::Vector3f(0.02F, 0.01F, 0.015F)});
  KnobDescription knob;
  knob.mesh_knob = std::make_shared<const model::TriangleMesh>(std::move(mesh));
  const KnobFace face = findFace(knob);
  EXPECT_EQ(face.turn_sign, 1.0);
  EXPECT_NEAR(face.height_m, 0.015, 1e-7);
  EXPECT_NEAR(face.radius_m, std::hypot(0.02, 0.01), 1e-7);
}

TEST(Knob, WithoutJointOrMeshIsRefusedByName) {
  model::ArticulatedModel oven = model::makeOven({});
  oven.name = "stove";
  model::ArticulatedModel loose = oven;
  loose.joints.clear();
  test::expectError(base::ErrorCode::kInput, {"stove", oven.knobs[0].name, "joint"}, [&] { (void)describeKnob(loose, 0); });
  oven.parts[static_cast<std::size_t>(oven.knobs[0].part)].mesh_part = nullptr;
  test::expectError(base::ErrorCode::kInput, {"stove", oven.knobs[0].name, "mesh"}, [&] { (void)describeKnob(oven, 0); });
}

TEST(Knob, WithoutExtentIsRefusedByName) {
  model::TriangleMesh flat;
  flat.vertices = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.02F, 0, 0), Eigen::Vector3f(0, 0.02F, 0)};
  flat.triangles = {{0, 1, 2}};
  KnobDescription knob;
  knob.name = "dial";
  knob.mesh_knob = std::make_shared<const model::TriangleMesh>(flat);
  test::expectError(base::ErrorCode::kInput, {"dial", "no extent"}, [&] { (void)findFace(knob); });
}

}  // namespace
}  // namespace oikos::recognition
