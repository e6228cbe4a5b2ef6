// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/ceiling_camera.h"

#include <gtest/gtest.h>

#include <memory>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "core/tags/board_pose.h"
#include "tests/support/config_rules_check.h"

namespace oikos::simulate {
namespace {

TEST(CeilingCamera, LooksWhereItIsTold) {
  const Eigen::Vector3d position(1.0, -2.0, 2.4);
  const Eigen::Vector3d target(2.0, 1.0, 0.3);
  const Eigen::Isometry3d T_map_camera = lookAt(position, target);
  const Eigen::Vector3d target_camera = T_map_camera.inverse() * target;
  EXPECT_NEAR(target_camera.head<2>().norm(), 0.0, 1e-12);
  EXPECT_NEAR(target_camera.z(), (target - position).norm(), 1e-12);
  EXPECT_NEAR(T_map_camera.linear()(2, 0), 0.0, 1e-12);  // x is level
  EXPECT_LT(T_map_camera.linear()(2, 1), 0.0);           // y is down
  EXPECT_NEAR(T_map_camera.linear().determinant(), 1.0, 1e-12);
  const Eigen::Isometry3d down = lookAt(position, Eigen::Vector3d(1.0, -2.0, 0.0));
  EXPECT_TRUE(down.linear().isApprox(Eigen::DiagonalMatrix<double, 3>(1.0, -1.0, -1.0).toDenseMatrix(), 1e-12)) << down.linear();
}

TEST(CeilingCamera, SeesTheBoardWhereTheRobotHasIt) {
  render::Scene scene;
  (void)scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox({6.0F, 6.0F, 0.1F})),
                  Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.05)));
  CeilingSettings settings;
  settings.position_m = {0.8, -0.5, 2.5};
  settings.distortion = {0.05, -0.1, 0.0005, -0.0005, 0.0};
  render::Lighting lighting;
  lighting.from_above_rgb.setConstant(0.6F);
  CeilingCamera camera(settings, lighting, scene);
  const Eigen::Isometry3d T_map_base =
      Eigen::Translation3d(0.3, 0.2, 0.0) * Eigen::Quaterniond(Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()));
  const cv::Mat color = camera.shoot(scene, T_map_base, {1, 0, 2});
  cv::Mat gray;
  cv::extractChannel(color, gray, 1);
  const auto pose =
      estimateBoardPose(settings.board, tags::TagDetector().detect(gray), {camera.calibration().color, camera.calibration().distortion});
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->corners, 24);
  const Eigen::Isometry3d found =
      tags::poseOf(camera.setup().T_map_camera) * pose->T_camera_board * tags::poseOf(camera.setup().T_base_board).inverse();
  EXPECT_LT((found.translation() - T_map_base.translation()).norm(), 0.004);
  EXPECT_LT(Eigen::AngleAxisd(found.linear().transpose() * T_map_base.linear()).angle(), 0.004);
}

TEST(CeilingCamera, Rules) {
  test::checkConfigRules<CeilingSettings>({{"width", "4097", "must be from 16 to 4096"},
                                           {"height", "4097", "must be from 16 to 4096"},
                                           {"fx", "0", "must be > 0"},
                                           {"fy", "nan", "must be > 0"},
                                           {"cx", "-1", "must be from 0 to 1280"},
                                           {"cy", "1025", "must be from 0 to 1024"},
                                           {"jpeg_quality", "101", "must be from 0 to 100"}});
  const auto problemOf = [](const auto& change) {
    CeilingSettings settings;
    settings.position_m = {0.0, 0.0, 2.4};
    change(settings);
    const auto problems = settings.validate();
    return problems.size() == 1 ? problems.front() : std::to_string(problems.size()) + " problems";
  };
  EXPECT_EQ(problemOf([](auto&) {}), "0 problems");
  EXPECT_EQ(problemOf([](auto& s) { s.position_m = {1.0}; }), "position_m = 1: must be three numbers: x, y, z (m) in map; or none");
  EXPECT_EQ(problemOf([](auto& s) { s.look_at_m = {1.0, 2.0}; }), "look_at_m = 2: must be three numbers: x, y, z (m) in map");
  EXPECT_EQ(problemOf([](auto& s) { s.look_at_m = s.position_m; }), "look_at_m = 3: must be another place than position_m");
  EXPECT_EQ(problemOf([](auto& s) { s.board_m = {}; }), "board_m = 0: must be three numbers: x, y, z (m) in base");
  EXPECT_EQ(problemOf([](auto& s) { s.distortion = {0.0}; }), "distortion = 1: must be five numbers: k1, k2, p1, p2, k3");
}

}  // namespace
}  // namespace oikos::simulate
