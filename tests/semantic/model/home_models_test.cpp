// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/home_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/error.h"
#include "core/model/mesh_file.h"
#include "core/model/primitives.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

LargeObject pieceOf(const std::string& id, const Shape& shape) {
  LargeObject object;
  object.id = {id};
  object.type = "cupboard";
  object.shape = shape;
  object.parking_poses = {{{{1.1, 0.0, 0.0}, {0.0, 0.0, 180.0 * kRadPerDeg}}, true}};
  object.articulation = articulationOf(makeShape(shape, id), object.id);
  return object;
}

const Shape kCupboard = {"cabinet", {{"width_m", "0.8"}, {"door_count", "2"}}};
const Shape kOven = {"oven", {{"knob_count", "3"}}};

/// Where each part of the shape is, and what the home's model has of its name is there too, at values that differ from joint to joint.
void expectSamePoses(const LargeObject& object, const model::ArticulatedModel& shape) {
  const model::ArticulatedModel made = ModelMaker("nowhere").make(object);
  std::vector<double> made_values(made.joints.size());
  std::vector<double> shape_values(shape.joints.size());
  for (std::size_t i = 0; i < shape.joints.size(); ++i) {
    const double value = shape.joints[i].upper * (0.3 + 0.1 * static_cast<double>(i));
    const std::string child = object.id.value + "-" + shape.parts[static_cast<std::size_t>(shape.joints[i].child)].name;
    const auto joint = std::find_if(made.joints.begin(), made.joints.end(), [&](const model::ModelJoint& j) {
      return made.parts[static_cast<std::size_t>(j.child)].name == child;
    });
    ASSERT_NE(joint, made.joints.end()) << child;
    shape_values[i] = value;
    made_values[static_cast<std::size_t>(joint - made.joints.begin())] = value;
  }
  const auto T_model_made = model::Kinematics(made).solve(made_values);
  const auto T_model_shape = model::Kinematics(shape).solve(shape_values);
  ASSERT_EQ(made.parts.size(), shape.parts.size());
  for (std::size_t i = 0; i < shape.parts.size(); ++i) {
    const auto part = std::find_if(made.parts.begin(), made.parts.end(),
                                   [&](const model::ModelPart& p) { return p.name == object.id.value + "-" + shape.parts[i].name; });
    ASSERT_NE(part, made.parts.end());
    const auto& T_model_part = T_model_made[static_cast<std::size_t>(part - made.parts.begin())];
    EXPECT_LT((T_model_part.translation() - T_model_shape[i].translation()).norm(), 1e-12) << part->name;
    EXPECT_LT((T_model_part.linear() - T_model_shape[i].linear()).norm(), 1e-12) << part->name;
    EXPECT_EQ(part->mesh_part->vertices, shape.parts[i].mesh_part->vertices) << part->name;
  }
}

TEST(ArticulationOf, ACupboardWithTwoDoors) {
  const LargeObject cupboard = pieceOf("cupboard", kCupboard);
  const Articulation& a = *cupboard.articulation;
  ASSERT_EQ(a.parts.size(), 3U);
  EXPECT_EQ(a.parts[0].id.value, "cupboard-body");
  EXPECT_EQ(a.parts[0].parent.value, "");
  EXPECT_EQ(a.parts[1].id.value, "cupboard-left_door");
  EXPECT_EQ(a.parts[1].parent.value, "cupboard-body");
  EXPECT_EQ(a.parts[2].id.value, "cupboard-right_door");
  ASSERT_EQ(a.joints.size(), 2U);
  EXPECT_EQ(a.joints[0].id.value, "cupboard-left_door-joint");
  EXPECT_EQ(a.joints[0].type, JointType::kRevolute);
  EXPECT_DOUBLE_EQ(a.joints[0].upper, 110.0 * kRadPerDeg);
  EXPECT_EQ(a.joints[0].value, 0.0);
  ASSERT_EQ(a.handles.size(), 2U);
  EXPECT_EQ(a.handles[0].part.value, "cupboard-left_door");
  EXPECT_TRUE(a.knobs.empty());
  expectSamePoses(cupboard, makeShape(kCupboard, "here"));
}

TEST(ArticulationOf, HandlesAreOfTheirKind) {
  const auto kindOf = [](const std::string& style) {
    return pieceOf("unit", {"drawer_unit", {{"handle", style}}}).articulation->handles.at(0).kind;
  };
  EXPECT_EQ(kindOf("bar_horizontal"), HandleKind::kBar);
  EXPECT_EQ(kindOf("knob"), HandleKind::kKnob);
  EXPECT_EQ(kindOf("recessed"), HandleKind::kRecessed);
}

TEST(ModelMaker, HandlesComeAlong) {
  const LargeObject cupboard = pieceOf("cupboard", kCupboard);
  const model::ArticulatedModel made = ModelMaker("").make(cupboard);
  ASSERT_EQ(made.handles.size(), 2U);
  EXPECT_EQ(made.handles[1].name, cupboard.articulation->handles[1].id);
  EXPECT_EQ(made.parts[static_cast<std::size_t>(made.handles[1].part)].name, "cupboard-right_door");
  EXPECT_EQ(made.handles[1].kind, HandleKind::kBar);
  EXPECT_EQ(made.handles[1].length_m, cupboard.articulation->handles[1].length_m);
}

TEST(ArticulationOf, AnOvenWithKnobs) {
  const LargeObject oven = pieceOf("oven", kOven);
  const Articulation& a = *oven.articulation;
  ASSERT_EQ(a.parts.size(), 2U);
  EXPECT_EQ(a.parts[1].id.value, "oven-door");
  EXPECT_EQ(a.joints.size(), 1U);
  ASSERT_EQ(a.knobs.size(), 3U);
  EXPECT_EQ(a.knobs[2].id.value, "oven-knob_2");
  EXPECT_EQ(a.knobs[2].part.value, "oven-body");
  EXPECT_EQ(a.knobs[2].states.size(), 10U);
  EXPECT_EQ(a.knobs[2].current, a.knobs[2].states.front().name);
  expectSamePoses(oven, makeShape(kOven, "here"));
}

TEST(ArticulationOf, ADrawerUnitSlides) {
  const Shape drawers = {"drawer_unit", {}};
  const LargeObject unit = pieceOf("unit", drawers);
  ASSERT_EQ(unit.articulation->joints.size(), 3U);
  EXPECT_EQ(unit.articulation->joints[2].type, JointType::kPrismatic);
  expectSamePoses(unit, makeShape(drawers, "here"));
}

TEST(JointValues, AreThoseOfTheJointsThenOfTheKnobsStates) {
  LargeObject oven = pieceOf("oven", kOven);
  oven.articulation->joints[0].value = 0.7;
  oven.articulation->knobs[1].current = oven.articulation->knobs[1].states[9].name;
  const std::vector<double> values = jointValues(oven);
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values[0], 0.7);
  EXPECT_EQ(values[1], 0.0);
  EXPECT_DOUBLE_EQ(values[2], 270.0 * kRadPerDeg);
  EXPECT_EQ(values.size(), ModelMaker("nowhere").make(oven).joints.size());
}

TEST(ModelMaker, KnobsAreKnobsOfTheModel) {
  const LargeObject oven = pieceOf("oven", kOven);
  const model::ArticulatedModel made = ModelMaker("nowhere").make(oven);
  ASSERT_EQ(made.knobs.size(), 3U);
  for (std::size_t i = 0; i < made.knobs.size(); ++i) {
    EXPECT_EQ(made.knobs[i].name, oven.articulation->knobs[i].id.value);
    EXPECT_EQ(made.parts[static_cast<std::size_t>(made.knobs[i].part)].name, made.knobs[i].name);
    EXPECT_EQ(made.knobs[i].states.size(), oven.articulation->knobs[i].states.size());
  }
}

TEST(ModelMaker, MakesBoxesWhereThereIsNoShape) {
  LargeObject table;
  table.id = {"table"};
  Box top;
  top.center.position_m = {0.0, 0.0, 0.7};
  top.size_m = {1.0, 2.0, 0.1};
  table.boxes_object = {top};
  const model::ArticulatedModel made = ModelMaker("nowhere").make(table);
  ASSERT_EQ(made.parts.size(), 1U);
  const Eigen::AlignedBox3f bounds = made.parts[0].mesh_part->bounds();
  EXPECT_TRUE(bounds.min().isApprox(Eigen::Vector3f(-0.5F, -1.0F, 0.65F), 1e-6F));
  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3f(0.5F, 1.0F, 0.75F), 1e-6F));
  LargeObject empty;
  EXPECT_EQ(ModelMaker("nowhere").make(empty).parts[0].mesh_part, nullptr);
}

TEST(ModelMaker, PartsOfBoxesAndAPartThatNoJointMoves) {
  LargeObject piece;
  piece.id = {"piece"};
  Box box;
  box.size_m = {1.0, 1.0, 1.0};
  piece.articulation.emplace();
  piece.articulation->parts = {{{"base"}, {}, {}, {}, {box}, {}}, {{"front"}, {}, {"base"}, {}, {box}, {}}};
  const model::ArticulatedModel made = ModelMaker("nowhere").make(piece);
  ASSERT_EQ(made.joints.size(), 1U);
  EXPECT_EQ(made.joints[0].type, model::MotionType::kFixed);
  EXPECT_EQ(jointValues(piece).size(), 1U);
  EXPECT_EQ(made.parts[1].mesh_part->triangles.size(), 12U);
}

TEST(ModelMaker, AModelFileWinsAndIsReadOnce) {
  const test::TemporaryFolder home;
  model::writeObj(model::makeBox({0.1F, 0.2F, 0.3F}), home.path() / "cup.obj");
  SmallObject cup;
  cup.id = {"cup"};
  cup.model = "cup.obj";
  cup.shape = Shape{"cup", {}};
  ModelMaker maker(home.path());
  const auto mesh = maker.make(cup).parts[0].mesh_part;
  EXPECT_TRUE(mesh->bounds().sizes().isApprox(Eigen::Vector3f(0.1F, 0.2F, 0.3F), 1e-5F));
  EXPECT_EQ(maker.make(cup).parts[0].mesh_part, mesh);
  cup.model.clear();
  EXPECT_NEAR(maker.make(cup).parts[0].mesh_part->bounds().max().z(), 0.095, 1e-6);
}

TEST(ModelMaker, NamesAMissingFileAndAWrongShape) {
  SmallObject cup;
  cup.id = {"cup"};
  cup.model = "gone.obj";
  test::expectError(base::ErrorCode::kIo, {"nowhere/gone.obj"}, [&] { (void)ModelMaker("nowhere").make(cup); });
  cup.model.clear();
  cup.shape = Shape{"cop", {}};
  test::expectError(base::ErrorCode::kInput, {"shape of 'cup'", "did you mean 'cup'"}, [&] { (void)ModelMaker("nowhere").make(cup); });
}

TEST(ModelMaker, AHomeOfShapesReadsBackWithoutErrors) {
  Home home;
  home.id = "home";
  home.name = "home";
  Room room;
  room.id = {"kitchen"};
  room.name = "kitchen";
  room.objects = {pieceOf("cupboard", kCupboard), pieceOf("oven", kOven)};
  home.rooms = {room};
  const HomeReading reading = readHomeText(toXml(home), "home.xml");
  for (const Finding& finding : reading.findings) {
    ADD_FAILURE() << finding.line << ": " << finding.element << ": " << finding.found;
  }
  ASSERT_TRUE(reading.complete);
  const LargeObject& oven = reading.home.rooms.at(0).objects.at(1);
  EXPECT_EQ(**oven.shape, kOven);
  expectSamePoses(oven, makeShape(kOven, "here"));
}

}  // namespace
}  // namespace oikos::semantic
