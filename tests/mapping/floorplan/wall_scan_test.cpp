// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/wall_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

constexpr double kOffLattice_m = 0.02;  ///< or a wall would lie on the edge of two cells

WallSketch sketchOf(const std::vector<Eigen::Isometry3d>& poses) {
  const Eigen::Isometry3d T_level_map(Eigen::Translation3d(kOffLattice_m, kOffLattice_m, 0.0));
  const oikos::test::AnalyticRoom room = oikos::test::AnalyticRoom::furnished();
  WallScanConfig config;
  config.pixel_stride = 1;
  WallScan scan(config);
  for (const Eigen::Isometry3d& pose : poses) {
    scan.add(room.render(oikos::test::smallCamera(), pose).depth_m, oikos::test::smallCamera(), T_level_map * pose);
  }
  return scan.sketch();
}

// A room of 4 m by 3 m about the origin: all that stands at least 60 cm high in it are its walls and the table's sides.
TEST(WallScan, WallsLieWhereTheyAreAndFaceTheRoom) {
  const WallSketch sketch = sketchOf(oikos::test::lookAround(24, 0.3, 1.0, 0.1));
  int on_walls = 0;
  for (const WallPoint& wall : sketch.walls) {
    const Eigen::Vector2d p = wall.point_level - Eigen::Vector2d::Constant(kOffLattice_m);
    EXPECT_NEAR(wall.normal_level.norm(), 1.0, 1e-9);
    EXPECT_LT(std::max(std::abs(p.x()) - 2.0, std::abs(p.y()) - 1.5), 1e-4);
    const bool on_x = std::abs(std::abs(p.x()) - 2.0) < 1e-4;
    const bool on_y = std::abs(std::abs(p.y()) - 1.5) < 1e-4;
    if (on_x || on_y) {
      ++on_walls;
      EXPECT_LT(wall.normal_level.dot(p), 0.0) << p.transpose();
    }
  }
  EXPECT_GT(10 * on_walls, 8 * static_cast<int>(sketch.walls.size()));
  EXPECT_NEAR(sketch.wallLengthM(), 14.0, 3.0);
}

TEST(WallScan, FloorIsWhereItWasSeenOnly) {
  const WallSketch sketch = sketchOf(oikos::test::lookAround(24, 0.3, 1.0, 0.6));
  EXPECT_GT(sketch.floor_level.size(), 500U);
  for (const Eigen::Vector2d& cell : sketch.floor_level) {
    EXPECT_LT(std::abs(cell.x()), 2.05);
    EXPECT_LT(std::abs(cell.y()), 1.55);
  }
}

TEST(WallScan, TheOrderOfViewsDoesNotMatter) {
  std::vector<Eigen::Isometry3d> poses = oikos::test::lookAround(12, 0.3, 1.0, 0.1);
  const WallSketch forward = sketchOf(poses);
  std::reverse(poses.begin(), poses.end());
  const WallSketch backward = sketchOf(poses);
  ASSERT_EQ(forward.walls.size(), backward.walls.size());
  for (std::size_t i = 0; i < forward.walls.size(); ++i) {
    EXPECT_LT((forward.walls[i].point_level - backward.walls[i].point_level).norm(), 1e-9);
  }
}

TEST(WallScan, NothingComesOfNothing) {
  WallScan scan({});
  const camera::PinholeCamera camera = oikos::test::smallCamera();
  scan.add(cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN())), camera,
           Eigen::Isometry3d::Identity());
  EXPECT_TRUE(scan.sketch().walls.empty());
  EXPECT_TRUE(scan.sketch().floor_level.empty());
}

}  // namespace
}  // namespace oikos::mapping
