// SPDX-License-Identifier: Apache-2.0
#include "tools/room_clouds.h"

#include <gtest/gtest.h>

#include "core/geometry/ply.h"
#include "tests/support/temporary_folder.h"

namespace oikos::tools {
namespace {

TEST(RoomClouds, EachRoomGetsWhatIsWithinItsOutlineAndItsWalls) {
  const test::TemporaryFolder folder;
  geometry::ColoredCloud cloud;
  cloud.points = {{1.0F, 1.0F, 0.5F}, {2.03F, 1.0F, 1.0F}, {3.0F, 1.0F, 0.0F}, {9.0F, 9.0F, 0.0F}};
  cloud.colors = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  writePly(cloud, folder.path() / "cloud.ply");
  semantic::Home home;
  home.rooms.resize(3);
  home.rooms[0].id.value = "left";
  home.rooms[0].outline_map = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}};
  home.rooms[1].id.value = "right";
  home.rooms[1].outline_map = {{2.06, 0.0}, {4.0, 0.0}, {4.0, 2.0}, {2.06, 2.0}};
  home.rooms[2].id.value = "unknown";
  writeRoomClouds(home, folder.path());
  const geometry::ColoredCloud left = geometry::readPly(folder.path() / "rooms/left.ply");
  const geometry::ColoredCloud right = geometry::readPly(folder.path() / "rooms/right.ply");
  ASSERT_EQ(left.points.size(), 2U);
  EXPECT_EQ(left.points[0], cloud.points[0]);
  EXPECT_EQ(left.colors[1][0], 2);
  ASSERT_EQ(right.points.size(), 2U);  // the point within the wall belongs to both
  EXPECT_EQ(right.points[1], cloud.points[2]);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "rooms/unknown.ply"));
}

}  // namespace
}  // namespace oikos::tools
