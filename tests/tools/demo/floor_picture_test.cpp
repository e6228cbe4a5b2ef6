// SPDX-License-Identifier: Apache-2.0
#include "tools/demo/floor_picture.h"

#include <gtest/gtest.h>

namespace oikos::demo {
namespace {

using namespace semantic;

/// A room of 4 m by 2 m: with its margins 4.8 m by 2.8 m, at 110 pixels a metre.
Home smallHome() {
  Home home;
  home.rooms.emplace_back();
  home.rooms[0].id.value = "room";
  home.rooms[0].outline_map = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 2.0}, {0.0, 2.0}};
  return home;
}

bool isDark(const cv::Vec3b& pixel) {
  return pixel[0] + pixel[1] + pixel[2] < 3 * 128;
}

TEST(FloorPicture, ShowsOutlinesAndPointsWithNorthUp) {
  const Home home = smallHome();
  geometry::ColoredCloud cloud;
  cloud.points = {{1.0F, 1.5F, 0.0F}, {1.0F, 1.5F, 1.0F}, {3.0F, 0.5F, 2.5F}};  // floor, a red thing above it, the ceiling
  cloud.colors = {{0, 255, 0}, {255, 0, 0}, {0, 0, 255}};
  const cv::Mat image = drawFloor({cloud, home, {}});
  EXPECT_EQ(image.size(), cv::Size(528, 308));
  EXPECT_TRUE(isDark(image.at<cv::Vec3b>(44, 264)));     // the northern wall
  EXPECT_TRUE(isDark(image.at<cv::Vec3b>(264, 264)));    // the southern
  const cv::Vec3b point = image.at<cv::Vec3b>(99, 154);  // (1, 1.5): nearer to the north
  EXPECT_GT(point[2], point[0] + 100);                   // red: what is higher covers what is lower
  EXPECT_GT(point[2], point[1] + 100);
  EXPECT_EQ(image.at<cv::Vec3b>(209, 374), cv::Vec3b(255, 255, 255));  // no ceiling
}

}  // namespace
}  // namespace oikos::demo
