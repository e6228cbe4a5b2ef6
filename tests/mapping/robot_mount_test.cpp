// SPDX-License-Identifier: Apache-2.0
#include "mapping/robot_mount.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <string>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

constexpr const char* kRobot = R"(<?xml version="1.0"?>
<robot name="test">
  <link name="base_footprint"/>
  <link name="mast"/>
  <link name="camera_link"/>
  <link name="camera_optical"/>
  <link name="arm"/>
  <joint name="lift" type="prismatic">
    <parent link="base_footprint"/><child link="mast"/>
    <origin xyz="0.1 0 0.2"/><axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="neck" type="revolute">
    <parent link="mast"/><child link="camera_link"/>
    <origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="optics" type="fixed">
    <parent link="camera_link"/><child link="camera_optical"/>
    <origin xyz="0.05 0 0" rpy="-1.5707963267948966 0 -1.5707963267948966"/>
  </joint>
  <joint name="shoulder" type="fixed">
    <parent link="base_footprint"/><child link="arm"/>
    <origin xyz="0 0.3 0.5"/>
  </joint>
</robot>
)";

std::string failureOf(const std::filesystem::path& urdf, const MountLinks& links, base::ErrorCode expected) {
  try {
    static_cast<void>(readMount(urdf, links));
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), expected);
    EXPECT_TRUE(std::string(error.what()).starts_with(urdf.string() + ": ")) << error.what();
    return std::string(error.what()).substr(urdf.string().size() + 2);
  }
  return "";
}

TEST(RobotMount, ChainsJointsAtZero) {
  const test::TemporaryFolder folder;
  const auto T_base_camera = readMount(folder.write("robot.urdf", kRobot), {"base_footprint", "camera_optical"});
  // The camera link is turned to the left by the neck's origin: forward of the lens (z) is the robot's left (y).
  EXPECT_TRUE(T_base_camera.translation().isApprox(Eigen::Vector3d(0.1, 0.05, 1.2), 1e-12));
  EXPECT_TRUE((T_base_camera.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE((T_base_camera.linear() * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(RobotMount, BaseNeedNotBeTheRoot) {
  const test::TemporaryFolder folder;
  const auto T_arm_camera = readMount(folder.write("robot.urdf", kRobot), {"arm", "camera_link"});
  EXPECT_TRUE(T_arm_camera.translation().isApprox(Eigen::Vector3d(0.1, -0.3, 0.7), 1e-12));
  const Eigen::AngleAxisd turn(T_arm_camera.linear());
  EXPECT_NEAR(turn.angle(), std::numbers::pi / 2, 1e-12);
}

TEST(RobotMount, SameLinkIsTheIdentity) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(readMount(folder.write("robot.urdf", kRobot), {"mast", "mast"}).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
}

TEST(RobotMount, NamesTheNearestLink) {
  const test::TemporaryFolder folder;
  const auto urdf = folder.write("robot.urdf", kRobot);
  EXPECT_EQ(failureOf(urdf, {"base_footprint", "camera_optcal"}, base::ErrorCode::kInput),
            "has no link 'camera_optcal'; did you mean 'camera_optical'?");
  EXPECT_EQ(failureOf(urdf, {"x", "camera_link"}, base::ErrorCode::kInput),
            "has no link 'x'; known: arm, base_footprint, camera_link, camera_optical, mast");
}

TEST(RobotMount, RejectsWhatIsNoUrdf) {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "no xml", "<robot name='x'/>", "<robot name='x'><link name='a'/><link name='b'/></robot>"}) {
    SCOPED_TRACE(text);
    const std::string failure = failureOf(folder.write("robot.urdf", text), {"a", "b"}, base::ErrorCode::kInput);
    EXPECT_TRUE(failure.starts_with("is not a valid URDF: ")) << failure;
    EXPECT_GT(failure.size(), std::string("is not a valid URDF: ").size());
  }
}

TEST(RobotMount, MissingFileIsAnIoError) {
  EXPECT_NE(failureOf("/no/such/robot.urdf", {"a", "b"}, base::ErrorCode::kIo), "");
}

}  // namespace
}  // namespace oikos::mapping
