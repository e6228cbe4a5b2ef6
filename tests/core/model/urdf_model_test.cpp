// SPDX-License-Identifier: Apache-2.0
#include "core/model/urdf_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/model/mesh_samples.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::model {
namespace {

using base::ErrorCode;

const std::string kCupboard = R"(<?xml version="1.0"?>
<robot name="cupboard">
  <material name="oak"><color rgba="0.6 0.4 0.2 1"/></material>
  <link name="body">
    <visual><origin xyz="0 0 0.5"/><geometry><box size="0.4 0.6 1.0"/></geometry><material name="oak"/></visual>
    <visual><geometry><cylinder radius="0.1" length="0.2"/></geometry></visual>
  </link>
  <link name="door">
    <visual><origin xyz="0 0.3 0" rpy="0 0 1.5707963267948966"/><geometry><mesh filename="../meshes/corner.obj" scale="0.1 0.1 -0.1"/></geometry></visual>
  </link>
  <link name="drawer"><visual><geometry><sphere radius="0.05"/></geometry></visual></link>
  <link name="frame"/>
  <joint name="hinge" type="revolute">
    <parent link="body"/><child link="door"/><origin xyz="0.2 -0.3 0.5" rpy="0 0 3.141592653589793"/>
    <axis xyz="0 0 2"/><limit lower="-0.1" upper="1.9" effort="1" velocity="1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="body"/><child link="drawer"/><axis xyz="1 0 0"/><limit lower="0" upper="0.35" effort="1" velocity="1"/>
  </joint>
  <joint name="wheel" type="continuous"><parent link="door"/><child link="knob"/><axis xyz="0 1 0"/></joint>
  <link name="knob"/>
  <joint name="stiff" type="fixed"><parent link="body"/><child link="frame"/></joint>
</robot>
)";

class ReadUrdf : public testing::Test {
 protected:
  ReadUrdf() { folder_.write("meshes/corner.obj", samples::kObjShape); }

  [[nodiscard]] UrdfModel read(const std::string& text) const { return readUrdf(folder_.write("urdf/a.urdf", text)); }
  void expectFailure(const std::string& text, std::vector<std::string> parts) const {
    const auto file = folder_.write("urdf/a.urdf", text);
    parts.push_back(file.string() + ": ");
    test::expectError(ErrorCode::kInput, parts, [&] { static_cast<void>(readUrdf(file)); });
  }
  /// A link "a" with this visual.
  void expectVisualFailure(const std::string& visual, std::vector<std::string> parts) const {
    parts.emplace_back("link 'a'");
    expectFailure("<robot name='r'><link name='a'><visual>" + visual + "</visual></link></robot>", parts);
  }
  /// A joint "j" from "a" to "b" with this inside.
  void expectJointFailure(const std::string& type, const std::string& inside, std::vector<std::string> parts) const {
    parts.emplace_back("j");
    expectFailure("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='" + type +
                      "'><parent link='a'/><child link='b'/>" + inside + "</joint></robot>",
                  parts);
  }
  test::TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const ModelPart& partOf(const ArticulatedModel& model, const std::string& name) {
  for (const ModelPart& part : model.parts) {
    if (part.name == name) {
      return part;
    }
  }
  throw std::runtime_error("no part " + name);
}

TEST_F(ReadUrdf, LinksBecomePartsWithTheirShapes) {
  const auto [model, warnings] = read(kCupboard);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(model.name, "cupboard");
  ASSERT_EQ(model.parts.size(), 5U);
  EXPECT_EQ(partOf(model, "frame").mesh_part, nullptr);
  const TriangleMesh& body = *partOf(model, "body").mesh_part;
  EXPECT_LT((body.bounds().min() - Eigen::Vector3f(-0.2F, -0.3F, -0.1F)).norm(), 1e-6F);
  EXPECT_LT((body.bounds().max() - Eigen::Vector3f(0.2F, 0.3F, 1.0F)).norm(), 1e-6F);
  EXPECT_LT((body.materialOf(0).color_rgb - Eigen::Vector3f(0.6F, 0.4F, 0.2F)).norm(), 1e-6F);
  EXPECT_EQ(body.materialOf(0).name, "oak");
  EXPECT_EQ(body.materialOf(body.triangles.size() - 1).color_rgb, Material{}.color_rgb);
  EXPECT_FLOAT_EQ(partOf(model, "drawer").mesh_part->bounds().max().z(), 0.05F);
}

TEST_F(ReadUrdf, MeshesAreScaledMirroredAndPlaced) {
  const auto urdf_model = read(kCupboard);
  const TriangleMesh& door = *partOf(urdf_model.model, "door").mesh_part;
  // The corner of 0.1 x 0.2 x -0.3, turned left by a quarter and moved by 0.3 along y.
  EXPECT_LT((door.bounds().min() - Eigen::Vector3f(-0.2F, 0.3F, -0.3F)).norm(), 1e-6F) << door.bounds().min().transpose();
  EXPECT_LT((door.bounds().max() - Eigen::Vector3f(0.0F, 0.4F, 0.0F)).norm(), 1e-6F) << door.bounds().max().transpose();
  EXPECT_NEAR(samples::volumeM3(door), 0.001, 1e-8);
}

TEST_F(ReadUrdf, JointsKeepAxisOriginAndLimits) {
  const auto [model, warnings] = read(kCupboard);
  ASSERT_EQ(model.joints.size(), 4U);
  const ModelJoint& hinge = model.joints[0];
  EXPECT_EQ(hinge.name, "hinge");
  EXPECT_EQ(hinge.type, MotionType::kRevolute);
  EXPECT_EQ(model.parts[static_cast<std::size_t>(hinge.parent)].name, "body");
  EXPECT_EQ(hinge.axis_joint, Eigen::Vector3d::UnitZ());
  EXPECT_DOUBLE_EQ(hinge.lower, -0.1);
  EXPECT_DOUBLE_EQ(hinge.upper, 1.9);
  EXPECT_EQ(model.joints[1].name, "slide");
  EXPECT_EQ(model.joints[1].type, MotionType::kPrismatic);
  EXPECT_DOUBLE_EQ(model.joints[1].upper, 0.35);
  EXPECT_EQ(model.joints[2].type, MotionType::kFixed);
  EXPECT_EQ(model.joints[3].type, MotionType::kRevolute);
  EXPECT_TRUE(std::isinf(model.joints[3].upper));
  const Kinematics kinematics(model);
  EXPECT_EQ(model.parts[static_cast<std::size_t>(kinematics.root())].name, "body");
  // The door's x points backwards when it is shut, and to the cupboard's right after a quarter turn.
  const auto T_model_part = kinematics.solve({std::numbers::pi / 2.0, 0.2, 0.0, 0.0});
  const Eigen::Isometry3d& T_model_door = T_model_part[static_cast<std::size_t>(hinge.child)];
  EXPECT_LT((T_model_door.translation() - Eigen::Vector3d(0.2, -0.3, 0.5)).norm(), 1e-12);
  EXPECT_LT((T_model_door.linear() * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST_F(ReadUrdf, AMaterialReplacesTheMeshsOwn) {
  folder_.write("meshes/corner.mtl", "newmtl red\nKd 1 0 0\n");
  folder_.write("meshes/corner.obj", "mtllib corner.mtl\nusemtl red\n" + samples::kObjShape);
  const std::string link =
      "<robot name='r'><link name='a'><visual><geometry><mesh filename='../meshes/corner.obj'/></geometry>%</visual></link></robot>";
  EXPECT_EQ(read(replaced(link, "%", "")).model.parts[0].mesh_part->materialOf(0).name, "red");
  const auto painted = read(replaced(link, "%", "<material name='blue'><color rgba='0 0 1 1'/></material>"));
  EXPECT_EQ(painted.model.parts[0].mesh_part->materialOf(0).color_rgb, Eigen::Vector3f(0.0F, 0.0F, 1.0F));
}

TEST_F(ReadUrdf, WarnsOfWhatIsLeftOut) {
  const auto mimic = read(replaced(kCupboard, "<axis xyz=\"1 0 0\"/>", "<axis xyz=\"1 0 0\"/><mimic joint=\"hinge\"/>"));
  ASSERT_EQ(mimic.warnings.size(), 1U);
  EXPECT_EQ(mimic.warnings[0], "joint 'slide' mimics 'hinge': here it moves on its own");
  EXPECT_EQ(mimic.model.joints[1].type, MotionType::kPrismatic);
  const auto huge = read(replaced(kCupboard, "scale=\"0.1 0.1 -0.1\"", ""));
  EXPECT_TRUE(huge.warnings.empty());
  folder_.write("meshes/corner.obj", "v 0 0 0\nv 900 0 0\nv 0 700 0\nf 1 2 3\n");
  const auto units = read(kCupboard);
  ASSERT_EQ(units.warnings.size(), 1U);
  EXPECT_EQ(units.warnings[0], "link 'door': mesh '../meshes/corner.obj' is 900.0 m in size: is it in metres?");
}

TEST_F(ReadUrdf, RefusesWrongVisuals) {
  expectVisualFailure("<geometry><mesh filename='package://robot/door.obj'/></geometry>", {"package://robot/door.obj", "relative"});
  expectVisualFailure("<geometry><mesh filename='http://example.org/door.obj'/></geometry>", {"http://example.org"});
  expectVisualFailure("<geometry><mesh filename='/tmp/door.obj'/></geometry>", {"/tmp/door.obj", "relative"});
  expectVisualFailure("<geometry><mesh filename='gone.obj'/></geometry>", {"gone.obj"});
  expectVisualFailure("<geometry><mesh filename='../meshes/corner.obj' scale='1 0 1'/></geometry>", {"scale"});
  expectVisualFailure("<geometry><box size='1 -1 1'/></geometry>", {"size -1"});
  expectVisualFailure("<geometry><cylinder radius='0' length='1'/></geometry>", {"radius 0"});
  expectVisualFailure("<geometry><sphere radius='-2'/></geometry>", {"radius -2"});
}

TEST_F(ReadUrdf, RefusesWrongJoints) {
  expectJointFailure("planar", "<axis xyz='0 0 1'/>", {"joint 'j'", "planar", "must be revolute"});
  expectJointFailure("floating", "", {"joint 'j'", "floating"});
  expectJointFailure("spherical", "", {"spherical"});
  expectJointFailure("revolute", "<axis xyz='0 0 0'/><limit lower='0' upper='1' effort='1' velocity='1'/>", {"axis"});
  expectJointFailure("revolute", "<axis xyz='0 0 1'/><limit lower='2' upper='1' effort='1' velocity='1'/>", {"limits from 2 to 1"});
  expectJointFailure("revolute", "<axis xyz='0 0 1'/>", {"limits"});
  expectJointFailure("fixed", "<origin xyz='nan 0 0'/>", {});
  expectJointFailure("fixed", "<origin xyz='1e999 0 0'/>", {});
}

TEST_F(ReadUrdf, RefusesWhatIsNoUrdfOrNoTree) {
  for (const char* text : {"", "no xml", "<robot/>", "<robot name='x'/>", "<sdf/>"}) {
    SCOPED_TRACE(text);
    expectFailure(text, {"not a valid URDF"});
  }
  expectFailure("<robot name='r'><link name='a'/><link name='b'/></robot>", {"not a valid URDF", "root"});
  expectFailure("<robot name='r'><link name='a'/><joint name='j' type='fixed'><parent link='a'/><child link='gone'/></joint></robot>",
                {"gone"});
  expectFailure(
      "<robot name='r'><link name='root'/><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/><child "
      "link='b'/></joint><joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
      {"circle"});
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 200'000; ++i) {
    deep += "<a>";
  }
  expectFailure(deep, {"nested too deep"});
  test::expectError(ErrorCode::kIo, {"/no/such.urdf"}, [] { static_cast<void>(readUrdf("/no/such.urdf")); });
}

}  // namespace
}  // namespace oikos::model
