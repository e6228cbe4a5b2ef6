// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/floor_finder.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "mapping/volume/depth_filter.h"
#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

const camera::PinholeCamera kCamera{320, 240, 260.0, 260.0, 159.5, 119.5};

/// Some frame that is not the map's: what a pose graph starts from.
Eigen::Isometry3d worldFrame() {
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  T_world_map.linear() = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, -0.4, 0.3).normalized()).toRotationMatrix();
  T_world_map.translation() = Eigen::Vector3d(0.4, -3.0, 1.0);
  return T_world_map;
}

FloorResult findIn(const test::AnalyticRoom& room, const std::vector<Eigen::Isometry3d>& poses) {
  FloorConfig config;
  config.pixel_stride = 2;  // the images are small
  FloorFinder finder(config);
  for (const Eigen::Isometry3d& T_map_camera : poses) {
    finder.add(filterDepth(room.render(kCamera, T_map_camera).depth_m, {}), kCamera, worldFrame() * T_map_camera);
  }
  return finder.find();
}

void expectFloor(const FloorResult& floor, const Eigen::Isometry3d& T_map_first) {
  ASSERT_EQ(floor.status, FloorStatus::kFound);
  const Eigen::Isometry3d T_found_map = floor.T_map_world * worldFrame();
  const double up_error_rad = std::acos(std::min(1.0, T_found_map.linear()(2, 2)));
  EXPECT_LT(up_error_rad, 0.005);
  EXPECT_NEAR((T_found_map * Eigen::Vector3d::Zero()).z(), 0.0, 0.005);
  const Eigen::Isometry3d T_found_first = T_found_map * T_map_first;
  EXPECT_NEAR(T_found_first.translation().x(), 0.0, 1e-9);
  EXPECT_NEAR(T_found_first.translation().y(), 0.0, 1e-9);
  EXPECT_NEAR(T_found_first.translation().z(), T_map_first.translation().z(), 0.01);
  EXPECT_NEAR(T_found_first.linear()(1, 2), 0.0, 1e-9);  // the optical axis lies over x
  EXPECT_GT(T_found_first.linear()(0, 2), 0.0);
  EXPECT_NEAR(floor.camera_height_m, T_map_first.translation().z(), 0.01);
}

TEST(FloorFinder, FindsTheFloorOfARoom) {
  const auto poses = test::lookAround(8, 0.3, 1.3, 0.5);
  const FloorResult floor = findIn(test::AnalyticRoom::furnished(), poses);
  expectFloor(floor, poses[0]);
  EXPECT_GT(floor.area_m2, 2.0);
  EXPECT_LT(floor.rms_m, 0.005);
  EXPECT_NEAR(floor.agreement, 1.0, 0.05);
  EXPECT_GT(floor.inliers, 500);
}

TEST(FloorFinder, PrefersALittleFloorToALargeTable) {
  const test::AnalyticRoom room({{-2.0, -1.5, 0.0}, {2.0, 1.5, 2.5}, {200, 200, 200}},
                                {{{0.0, -1.2, 0.0}, {1.9, 1.2, 0.75}, {220, 30, 30}}});
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 6; ++i) {
    poses.push_back(test::lookAt({-1.7, 0.1 * i, 1.5}, {0.6, 0.2 * i - 0.4, 0.3}));
  }
  expectFloor(findIn(room, poses), poses[0]);
}

TEST(FloorFinder, WithoutAFloorInSightZIsZeroAtTheCameraAndUpIsAGuess) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 6; ++i) {
    poses.push_back(test::lookAt({-1.0 + 0.1 * i, 0.0, 1.3}, {2.0, 0.2 * i, 1.5}));  // walls and ceiling
  }
  const FloorResult floor = findIn(test::AnalyticRoom::furnished(), poses);
  ASSERT_EQ(floor.status, FloorStatus::kNoFloor);
  const Eigen::Isometry3d T_found_first = floor.T_map_world * worldFrame() * poses[0];
  EXPECT_LT(T_found_first.translation().norm(), 1e-9);
  const double up_error_rad = std::acos(std::min(1.0, (floor.T_map_world * worldFrame()).linear()(2, 2)));
  EXPECT_LT(up_error_rad, 0.06);
  EXPECT_EQ(floor.inliers, 0);
}

TEST(FloorFinder, ATableThatStandsOnASeenFloorIsNotTheFloor) {
  const auto poses = test::lookAround(8, 0.3, 0.9, 0.3);
  const FloorResult floor = findIn(test::AnalyticRoom::furnished(), poses);
  ASSERT_EQ(floor.status, FloorStatus::kFound);
  EXPECT_NEAR(floor.camera_height_m, 0.9, 0.01);
}

TEST(FloorFinder, LooksStraightDown) {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear() = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T_map_camera.translation().z() = 1.5;
  FloorConfig config;
  config.max_tilt_rad = 1.5;
  FloorFinder finder(config);
  const test::AnalyticRoom room({{-3.0, -3.0, 0.0}, {3.0, 3.0, 2.5}, {200, 200, 200}}, {});
  for (int i = 0; i < 4; ++i) {
    finder.add(room.render(kCamera, T_map_camera).depth_m, kCamera, T_map_camera);
  }
  const FloorResult floor = finder.find();
  // Up is across the image here, farther from image-up than any prior allows: this must not be called a floor.
  EXPECT_EQ(floor.status, FloorStatus::kNoFloor);
  EXPECT_TRUE(floor.T_map_world.matrix().allFinite());
}

TEST(FloorFinder, NothingAddedAndNothingSeenAreDifferent) {
  FloorFinder finder{FloorConfig{}};
  EXPECT_EQ(finder.find().status, FloorStatus::kNoFrames);
  finder.add(cv::Mat(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(std::nan(""))), kCamera, Eigen::Isometry3d::Identity());
  const FloorResult floor = finder.find();
  EXPECT_EQ(floor.status, FloorStatus::kNoFloor);
  EXPECT_TRUE(floor.T_map_world.matrix().allFinite());
  EXPECT_EQ(floor.agreement, 0.0);
}

TEST(FloorFinder, SameBitsAgain) {
  const auto poses = test::lookAround(8, 0.3, 1.3, 0.5);
  const FloorResult first = findIn(test::AnalyticRoom::furnished(), poses);
  const FloorResult again = findIn(test::AnalyticRoom::furnished(), poses);
  EXPECT_EQ(first.T_map_world.matrix(), again.T_map_world.matrix());
}

}  // namespace
}  // namespace oikos::mapping
