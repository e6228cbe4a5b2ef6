// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>

#include "core/render/view.h"
#include "tests/support/analytic_room.h"
#include "tests/tools/simulate/small_home.h"
#include "tools/simulate/home_change.h"

namespace oikos::simulate {
namespace {

const camera::PinholeCamera kCamera{160, 120, 140.0, 140.0, 79.5, 59.5};

render::View viewOf(const World& world, const Eigen::Vector3d& from_map, const Eigen::Vector3d& to_map) {
  render::ViewConfig config;
  config.with_parts = true;
  config.with_color = true;
  return renderView(world.scene(), render::CameraRays(kCamera), {test::lookAt(from_map, to_map), {}}, config);
}

/// From the middle of the kitchen onto the table.
render::View tableView(const World& world) {
  return viewOf(world, {-1.0, 0.0, 1.4}, {1.0, 0.0, 0.75});
}

/// From above and before the drawers.
render::View drawersView(const World& world) {
  return viewOf(world, {4.0, 0.0, 1.4}, {5.3, 0.0, 0.7});
}

bool areEqual(const render::View& a, const render::View& b) {
  const auto sameBytes = [](const cv::Mat& x, const cv::Mat& y) {
    return x.total() == y.total() && x.type() == y.type() && std::memcmp(x.data, y.data, x.total() * x.elemSize()) == 0;
  };
  return sameBytes(a.depth_m, b.depth_m) && sameBytes(a.color, b.color) && sameBytes(a.part, b.part);
}

int pixelsOf(const World& world, const std::string& small, const render::View& view) {
  const int model = world.smallPieces().at(small).model;
  int count = 0;
  for (int v = 0; v < view.part.rows; ++v) {
    for (int u = 0; u < view.part.cols; ++u) {
      const int part = view.part.at<std::int32_t>(v, u);
      count += part >= 0 && world.scene().parts()[static_cast<std::size_t>(part)].model == model ? 1 : 0;
    }
  }
  return count;
}

semantic::Home changed(const std::string& text) {
  semantic::Home home = smallHome();
  apply(parseHomeChange(text).value(), home, "test");
  return home;
}

class Worlds : public testing::Test {
 protected:
  Worlds() { world_.update(smallHome()); }

  /// Made once: its textures take longer than the tests.
  static World& sharedWorld() {
    static World world(smallHome(), {".", 1, 2.5, 0.0});
    return world;
  }
  World& world_ = sharedWorld();
};

TEST_F(Worlds, AClosedRoomHasDepthEverywhere) {
  const render::View view = tableView(world_);
  EXPECT_EQ(cv::countNonZero(view.depth_m == view.depth_m), view.depth_m.rows * view.depth_m.cols);
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  cv::minMaxLoc(view.depth_m, &nearest_m, &farthest_m);
  EXPECT_LT(farthest_m, 4.5);  // nothing is seen through a wall
}

TEST_F(Worlds, WallsAreWhereTheOutlineHasThem) {
  const render::View view = viewOf(world_, {0.0, 0.0, 1.5}, {-2.0, 0.0, 1.5});
  EXPECT_NEAR(view.depth_m.at<float>(30, 80), 2.0, 1e-5);
}

TEST_F(Worlds, ADrawerDrawnOutIsNearer) {
  const render::View before = drawersView(world_);
  world_.update(changed("drawers-drawer_0-joint 0.3 m"));
  const render::View after = drawersView(world_);
  // The middle of the uppermost drawer's front, 0.02 m thick at most, as it stands open.
  const Eigen::Isometry3d T_camera_map = test::lookAt({4.0, 0.0, 1.4}, {5.3, 0.0, 0.7}).inverse();
  const Eigen::Vector3d front_camera = T_camera_map * Eigen::Vector3d(5.6 - 0.29 - 0.3, 0.1, 0.73);
  const Eigen::Vector2d pixel = kCamera.project(front_camera);
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  EXPECT_NEAR(after.depth_m.at<float>(v, u), front_camera.z(), 0.03);
  EXPECT_GT(before.depth_m.at<float>(v, u), front_camera.z() + 0.1);
  EXPECT_EQ(before.depth_m.at<float>(0, 0), after.depth_m.at<float>(0, 0));
}

TEST_F(Worlds, ThereAndBackAgainGivesTheSameBytes) {
  const render::View table = tableView(world_);
  const render::View drawers = drawersView(world_);
  for (const char* text : {"drawers-drawer_0-joint 0.3 m", "oven-door-joint 60 deg", "oven-knob_0 2", "cup on table at -0.2 0.1 0.75 0 0 0",
                           "cup gone", "table at 0.8 0.1 0 0 0 90", "table gone", "cup in drawers-drawer_1 at -0.1 0 0.02 0 0 0"}) {
    world_.update(changed(text));
    (void)tableView(world_);
    world_.update(smallHome());
    EXPECT_TRUE(areEqual(tableView(world_), table)) << text;
    EXPECT_TRUE(areEqual(drawersView(world_), drawers)) << text;
  }
}

TEST_F(Worlds, AStateReachedIsTheSameAsOneStartedIn) {
  const World made(changed("table at 0.8 0.1 0 0 0 90"), {".", 1, 2.5, 0.0});
  world_.update(changed("table at 0.8 0.1 0 0 0 90"));
  EXPECT_TRUE(areEqual(tableView(world_), tableView(made)));
}

TEST_F(Worlds, ACupStandsOnTheTable) {
  const render::View view = tableView(world_);
  EXPECT_GT(pixelsOf(world_, "cup", view), 20);
  EXPECT_LT((world_.smallPieces().at("cup").T_map_object.translation() - Eigen::Vector3d(0.8, 0.0, 0.75)).norm(), 1e-12);
}

TEST_F(Worlds, WhatIsGoneIsNotSeen) {
  world_.update(changed("cup gone"));
  EXPECT_EQ(pixelsOf(world_, "cup", tableView(world_)), 0);
  EXPECT_FALSE(world_.smallPieces().at("cup").is_shown);
  world_.update(changed("table gone"));  // and the cup with it
  EXPECT_EQ(pixelsOf(world_, "cup", tableView(world_)), 0);
  const render::View view = tableView(world_);
  const Eigen::Isometry3d T_map_camera = test::lookAt({-1.0, 0.0, 1.4}, {1.0, 0.0, 0.75});
  const Eigen::Vector3d middle_map = T_map_camera * (view.depth_m.at<float>(90, 80) * kCamera.ray(80.0, 90.0));
  EXPECT_NEAR(middle_map.z(), 0.0, 1e-4);  // the floor where the table stood
}

TEST_F(Worlds, SmallObjectsGoAlongWithTheirDrawer) {
  world_.update(changed("cup in drawers-drawer_1 at -0.1 0 0.02 0 0 0"));
  EXPECT_LT((world_.smallPieces().at("cup").T_map_object.translation() - Eigen::Vector3d(5.6 - 0.29 - 0.1 + 0.1, 0.0, 0.495)).norm(), 1e-9);
}

TEST(CeilingLamps, HangOneInEachRoom) {
  const std::vector<render::PointLight> lamps = ceilingLamps(smallHome(), 2.5);
  ASSERT_EQ(lamps.size(), 2U);
  EXPECT_LT((lamps[0].position_map - Eigen::Vector3d(0.0, 0.0, 2.25)).norm(), 1e-9);
  EXPECT_LT((lamps[1].position_map - Eigen::Vector3d(4.1, 0.0, 2.25)).norm(), 1e-9);
}

}  // namespace
}  // namespace oikos::simulate
