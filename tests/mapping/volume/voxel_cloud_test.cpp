// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/voxel_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/geometry/ply.h"
#include "tests/support/analytic_room.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

geometry::ColoredCloud extract(const VoxelCloud& cloud) {
  geometry::ColoredCloud extracted;
  cloud.forEachPoint([&](const Eigen::Vector3f& point, const geometry::Rgb& color) {
    extracted.points.push_back(point);
    extracted.colors.push_back(color);
  });
  return extracted;
}

/// A camera of one pixel that looks along z: the point is (0, 0, depth).
const camera::PinholeCamera kOnePixel{1, 1, 1.0, 1.0, 0.0, 0.0};

camera::RgbdFrame onePixel(float depth_m, const cv::Vec3b& bgr) {
  camera::RgbdFrame frame;
  frame.depth_m = cv::Mat(1, 1, CV_32FC1, cv::Scalar(depth_m));
  frame.color = cv::Mat(1, 1, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2]));
  return frame;
}

VoxelCloud lookAround(const std::vector<std::size_t>& order) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const camera::PinholeCamera camera = test::smallCamera();
  const auto poses = test::lookAround(8, 0.3, 1.3, 0.4);
  VoxelCloud cloud({0.02, 1, 1});
  for (const std::size_t i : order) {
    const camera::RgbdFrame frame = room.render(camera, poses[i]);
    cloud.add({frame, camera, poses[i]});
  }
  return cloud;
}

TEST(VoxelCloud, GivesTheCentroidOfPositionAndColour) {
  VoxelCloud cloud({0.01, 1, 1});
  for (const auto& [depth_m, bgr] :
       {std::pair{1.002F, cv::Vec3b(10, 20, 30)}, {1.006F, cv::Vec3b(20, 40, 60)}, {2.0F, cv::Vec3b(1, 2, 3)}}) {
    const camera::RgbdFrame frame = onePixel(depth_m, bgr);
    cloud.add({frame, kOnePixel, Eigen::Isometry3d::Identity()});
  }
  const geometry::ColoredCloud extracted = extract(cloud);
  ASSERT_EQ(extracted.points.size(), 2U);
  EXPECT_EQ(cloud.pointCount(), 2U);
  EXPECT_NEAR(extracted.points[0].z(), 1.004, 0.01 / 256);
  EXPECT_EQ(extracted.colors[0], (geometry::Rgb{45, 30, 15}));  // red first
  EXPECT_NEAR(extracted.points[1].z(), 2.0, 0.01 / 256);
}

TEST(VoxelCloud, LeavesOutVoxelsWithTooFewReadingsAndHoles) {
  VoxelCloud cloud({0.01, 1, 2});
  for (const float depth_m : {1.001F, 1.002F, 3.0F, std::numeric_limits<float>::quiet_NaN()}) {
    const camera::RgbdFrame frame = onePixel(depth_m, {0, 0, 0});
    cloud.add({frame, kOnePixel, Eigen::Isometry3d::Identity()});
  }
  EXPECT_EQ(extract(cloud).points.size(), 1U);
}

TEST(VoxelCloud, AVoxelThatIsFullTakesNoMore) {
  VoxelCloud cloud({0.01, 1, 1});
  const camera::RgbdFrame first = onePixel(1.001F, {100, 100, 100});
  const camera::RgbdFrame late = onePixel(1.009F, {200, 200, 200});
  for (int i = 0; i < 65535; ++i) {
    cloud.add({first, kOnePixel, Eigen::Isometry3d::Identity()});
  }
  cloud.add({late, kOnePixel, Eigen::Isometry3d::Identity()});
  const geometry::ColoredCloud extracted = extract(cloud);
  ASSERT_EQ(extracted.points.size(), 1U);
  EXPECT_NEAR(extracted.points[0].z(), 1.001, 0.01 / 256);
  EXPECT_EQ(extracted.colors[0], (geometry::Rgb{100, 100, 100}));
}

TEST(VoxelCloud, OrderOfFramesDoesNotMatter) {
  const geometry::ColoredCloud forwards = extract(lookAround({0, 1, 2, 3, 4, 5, 6, 7}));
  const geometry::ColoredCloud backwards = extract(lookAround({7, 3, 6, 5, 0, 4, 2, 1}));
  EXPECT_GT(forwards.points.size(), 10000U);
  EXPECT_EQ(forwards.points, backwards.points);
  EXPECT_EQ(forwards.colors, backwards.colors);
}

TEST(VoxelCloud, LiesOnTheRoomsSurfaces) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const geometry::ColoredCloud cloud = extract(lookAround({0, 1, 2, 3, 4, 5, 6, 7}));
  double largest_m = 0.0;
  for (const Eigen::Vector3f& point : cloud.points) {
    largest_m = std::max(largest_m, room.distanceToSurface(point.cast<double>()));
  }
  EXPECT_LT(largest_m, 0.01);  // a voxel's centroid cuts corners by up to half a voxel
}

TEST(VoxelCloud, IsReadBackFromItsFile) {
  const test::TemporaryFolder folder;
  const VoxelCloud cloud = lookAround({0, 1});
  cloud.write(folder.path() / "cloud.ply");
  const geometry::ColoredCloud read = geometry::readPly(folder.path() / "cloud.ply");
  const geometry::ColoredCloud expected = extract(cloud);
  EXPECT_EQ(read.points, expected.points);
  EXPECT_EQ(read.colors, expected.colors);
}

TEST(VoxelCloud, RefusesFramesWithoutColour) {
  VoxelCloud cloud({0.01, 1, 1});
  camera::RgbdFrame frame = onePixel(1.0F, {0, 0, 0});
  frame.color = cv::Mat();
  EXPECT_THROW(cloud.add({frame, kOnePixel, Eigen::Isometry3d::Identity()}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::mapping
