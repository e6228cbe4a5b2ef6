// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/truth_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/read_file.h"
#include "core/render/view.h"
#include "tests/support/analytic_room.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/simulate/small_home.h"
#include "tools/simulate/home_change.h"

namespace oikos::simulate {
namespace {

using Json = nlohmann::json;

semantic::Shape boxShape(double width_m, double depth_m, double height_m) {
  return {"box", {{"width_m", std::to_string(width_m)}, {"depth_m", std::to_string(depth_m)}, {"height_m", std::to_string(height_m)}}};
}

/// A cube of 0.4 m, its front at x = 2.9 m, and a screen before it (x from 1.4 m to 1.6 m) that covers y < `edge_m`.
semantic::Home screenedHome(double edge_m) {
  semantic::Home home;
  semantic::Room room;
  room.id.value = "room";
  semantic::LargeObject screen;
  screen.id.value = "screen";
  screen.shape = semantic::CopyOnWrite<semantic::Shape>(boxShape(1.0, 0.2, 1.5));
  screen.T_map_object.position_m = {1.5, edge_m - 0.5, 0.0};
  room.objects.emplace_back(screen);
  semantic::SmallObject cube;
  cube.id.value = "cube";
  cube.type = "cube";
  cube.parent = "room";
  cube.shape = semantic::CopyOnWrite<semantic::Shape>(boxShape(0.4, 0.4, 0.4));
  cube.T_parent_object.position_m = {3.1, 0.0, 0.3};
  room.small_objects.push_back(cube);
  home.rooms.push_back(room);
  return home;
}

camera::Calibration calibrationOf(const camera::LensDistortion& distortion = {}) {
  camera::Calibration calibration;
  calibration.color = {640, 480, 525.0, 525.0, 319.5, 239.5};
  calibration.distortion = distortion;
  return calibration;
}

Shot shotOf(const World& world, const camera::Calibration& calibration, const Eigen::Isometry3d& T_map_camera) {
  render::ViewConfig config;
  config.with_parts = true;
  const render::View view =
      renderView(world.scene(), render::CameraRays(calibration.color, calibration.distortion), {T_map_camera, {}}, config);
  Shot shot;
  shot.part = view.part;
  shot.depth_m = view.depth_m;
  shot.T_map_camera = T_map_camera;
  return shot;
}

const Eigen::Isometry3d kT_map_camera = test::lookAt({0.0, 0.0, 0.5}, {1.0, 0.0, 0.5});

/// The line that is written of one picture.
Json noted(const semantic::Home& home, const Eigen::Isometry3d& T_map_camera, const camera::LensDistortion& distortion = {}) {
  const World world(home, {".", 0, 2.5, 0.0});
  TruthLog log(calibrationOf(distortion));
  log.noteObjects(world, shotOf(world, calibrationOf(distortion), T_map_camera), 1.5);
  const test::TemporaryFolder folder;
  log.write(folder.path());
  return Json::parse(base::readFile(folder.path() / "objects.jsonl"));
}

/// The middle of a box's shape is at half its height above its origin: `height` from 0.3 m to 0.7 m about the camera's 0.5 m.
constexpr double kHalfCube_px = 525.0 * 0.2 / 2.9;

TEST(TruthLog, TheVisibleShareIsWhatTheScreenLeaves) {
  for (const double edge_m : {-0.2, -0.05, 0.0, 0.03, 0.06}) {
    const Json line = noted(screenedHome(edge_m), kT_map_camera);
    EXPECT_EQ(line["t"], 1.5);
    ASSERT_EQ(line["objects"].size(), 1U) << edge_m;
    const Json& cube = line["objects"][0];
    EXPECT_EQ(cube["id"], "cube");
    // The screen's near side hides what is to the left of the middle, its far side what is to the right.
    const double hidden_until_m = std::clamp(edge_m * 2.9 / (edge_m > 0.0 ? 1.4 : 1.6), -0.2, 0.2);
    EXPECT_NEAR(cube["visible_share"].get<double>(), (0.2 - hidden_until_m) / 0.4, 1.5 / (2.0 * kHalfCube_px)) << edge_m;
    const auto box = cube["box_px"].get<std::vector<int>>();
    ASSERT_EQ(box.size(), 4U);
    EXPECT_NEAR(box[0], 319.5 - kHalfCube_px, 1.0);
    EXPECT_NEAR(box[1], 239.5 - kHalfCube_px, 1.0);
    EXPECT_NEAR(box[2], 319.5 - hidden_until_m * 525.0 / 2.9, 1.0);
    EXPECT_NEAR(box[3], 239.5 + kHalfCube_px, 1.0);
  }
}

TEST(TruthLog, WhatIsNotSeenIsNotListed) {
  EXPECT_EQ(noted(screenedHome(0.3), kT_map_camera)["objects"], Json::array());
  EXPECT_EQ(noted(screenedHome(-0.3), test::lookAt({0.0, 0.0, 0.5}, {-1.0, 0.0, 0.5}))["objects"], Json::array());
}

TEST(TruthLog, ThePoseIsExact) {
  const Eigen::Isometry3d T_map_camera = test::lookAt({0.3, 0.4, 0.9}, {2.9, 0.1, 0.4});
  const Json line = noted(screenedHome(-0.5), T_map_camera);
  const auto n = line["objects"][0]["T_camera_object"].get<std::vector<double>>();
  ASSERT_EQ(n.size(), 7U);
  const Eigen::Isometry3d T_camera_object = Eigen::Translation3d(n[0], n[1], n[2]) * Eigen::Quaterniond(n[6], n[3], n[4], n[5]);
  const Eigen::Isometry3d expected = T_map_camera.inverse() * Eigen::Translation3d(3.1, 0.0, 0.3);
  EXPECT_TRUE(T_camera_object.isApprox(expected, 1e-12));
}

TEST(TruthLog, ALensBendsThePictureNotTheShare) {
  camera::LensDistortion lens;
  lens.k1 = -0.25;
  lens.k2 = 0.05;
  const Eigen::Isometry3d T_map_camera = test::lookAt({0.0, 0.0, 0.5}, {2.9, 1.2, 1.2});  // the cube is near the picture's corner
  const Json line = noted(screenedHome(-2.0), T_map_camera, lens);
  ASSERT_EQ(line["objects"].size(), 1U);
  EXPECT_EQ(line["objects"][0]["visible_share"], 1.0);
  const Json half = noted(screenedHome(0.0), kT_map_camera, lens);
  EXPECT_NEAR(half["objects"][0]["visible_share"].get<double>(), 0.5, 1.5 / (2.0 * kHalfCube_px));
}

TEST(TruthLog, WhatLeavesThePictureIsNotHidden) {
  const Json line = noted(screenedHome(-2.0), test::lookAt({0.0, 0.0, 0.5}, {2.9, 1.75, 0.5}));
  ASSERT_EQ(line["objects"].size(), 1U);
  EXPECT_EQ(line["objects"][0]["visible_share"], 1.0);
  EXPECT_EQ(line["objects"][0]["box_px"][2], 639);
}

TEST(TruthLog, AnObjectAroundTheCameraIsJudgedByTheWholePicture) {
  semantic::Home home = screenedHome(0.0);
  home.rooms[0].small_objects[0].T_parent_object.position_m = {0.1, 0.0, 0.3};  // its near side lies behind the camera
  home.rooms[0].objects[0].edit().T_map_object.position_m.x() = 0.2;            // half within it
  const Json line = noted(home, kT_map_camera);
  ASSERT_EQ(line["objects"].size(), 1U);
  EXPECT_NEAR(line["objects"][0]["visible_share"].get<double>(), 0.5, 0.02);
}

TEST(TruthLog, StatesAreNotedWhenTheyChange) {
  TruthLog log(calibrationOf());
  semantic::Home home = smallHome();
  log.noteStates(home, 0.0);
  log.noteStates(home, 0.1);
  apply(parseHomeChange("oven-door-joint 45 deg").value(), home, "test");
  apply(parseHomeChange("oven-knob_0 2").value(), home, "test");
  log.noteStates(home, 0.2);
  apply(parseHomeChange("drawers-drawer_1-joint 0.25 m").value(), home, "test");
  log.noteStates(home, 0.3);
  const test::TemporaryFolder folder;
  log.write(folder.path());
  EXPECT_EQ(base::readFile(folder.path() / "states.csv"),
            "t,id,value,unit\n"
            "0,oven-door-joint,0,deg\n"
            "0,oven-knob_0,0,state\n"
            "0,drawers-drawer_0-joint,0,m\n"
            "0,drawers-drawer_1-joint,0.1,m\n"
            "0,drawers-drawer_2-joint,0,m\n"
            "0.2,oven-door-joint,45,deg\n"
            "0.2,oven-knob_0,2,state\n"
            "0.3,drawers-drawer_1-joint,0.25,m\n");
}

}  // namespace
}  // namespace oikos::simulate
