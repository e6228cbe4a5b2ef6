// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/occupancy_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <sstream>

#include "core/base/error.h"
#include "mapping/volume/depth_scan.h"
#include "tests/support/analytic_room.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

OccupancyIntegrator occupancyOfRoom() {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const camera::PinholeCamera camera = test::smallCamera();
  OccupancyConfig config;
  config.pixel_stride = 1;
  OccupancyIntegrator occupancy(config, 1);
  for (const Eigen::Isometry3d& T_map_camera : test::lookAround(24, 0.3, 1.3, 0.5)) {
    const camera::RgbdFrame frame = room.render(camera, T_map_camera);
    occupancy.insert(makeScan({frame, camera, T_map_camera}, config));
  }
  return occupancy;
}

Cell cellAt(const OccupancyGrid& grid, double x_m, double y_m) {
  const int column = static_cast<int>(std::floor((x_m - grid.corner_map.x()) / grid.resolution_m));
  const int row = static_cast<int>(std::floor((y_m - grid.corner_map.y()) / grid.resolution_m));
  return column >= 0 && row >= 0 && column < grid.width && row < grid.height ? grid.at(column, row) : Cell::kUnknown;
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

TEST(OccupancyGrid, ShowsTheRoomFromAbove) {
  const OccupancyGrid grid = projectOccupancy(occupancyOfRoom(), OccupancyGridConfig{});
  EXPECT_EQ(cellAt(grid, 1.0, 0.0), Cell::kOccupied);    // table
  EXPECT_EQ(cellAt(grid, -1.6, 1.05), Cell::kOccupied);  // chest
  EXPECT_EQ(cellAt(grid, -2.02, 0.0), Cell::kOccupied);  // wall
  EXPECT_EQ(cellAt(grid, 0.0, 0.0), Cell::kUnknown);     // under the camera, never seen low
  EXPECT_EQ(cellAt(grid, -1.0, 0.0), Cell::kFree);
  EXPECT_EQ(cellAt(grid, 0.0, 1.2), Cell::kFree);
  EXPECT_EQ(cellAt(grid, -1.5, -1.2), Cell::kFree);
  EXPECT_EQ(cellAt(grid, 3.0, 0.0), Cell::kUnknown);  // beyond the wall
}

TEST(OccupancyGrid, ALowRobotPassesUnderWhatIsHigher) {
  OccupancyIntegrator occupancy(OccupancyConfig{}, 1);
  OccupancyScan shelf;
  shelf.origin_map = {0.0F, 0.0F, 0.5F};
  shelf.points_map = {{1.0F, 0.0F, 0.8F}, {1.5F, 0.0F, 0.2F}};
  occupancy.insert(shelf);
  OccupancyGridConfig low;
  low.robot_height_m = 0.5;
  EXPECT_EQ(cellAt(projectOccupancy(occupancy, OccupancyGridConfig{}), 1.0, 0.0), Cell::kOccupied);
  EXPECT_EQ(cellAt(projectOccupancy(occupancy, low), 1.0, 0.0), Cell::kFree);
}

TEST(OccupancyGrid, IsAllUnknownWithoutAFloor) {
  const OccupancyGrid grid = projectOccupancy(occupancyOfRoom(), OccupancyGridConfig{});
  const OccupancyGrid unknown = withAllUnknown(grid);
  EXPECT_EQ(unknown.width, grid.width);
  EXPECT_TRUE(std::all_of(unknown.cells.begin(), unknown.cells.end(), [](Cell cell) { return cell == Cell::kUnknown; }));
}

TEST(OccupancyGrid, NothingKnownIsOneUnknownCell) {
  const OccupancyGrid grid = projectOccupancy(OccupancyIntegrator(OccupancyConfig{}, 1), OccupancyGridConfig{});
  EXPECT_EQ(grid.cells, std::vector<Cell>{Cell::kUnknown});
}

TEST(OccupancyGrid, IsWrittenAsMapServerReadsIt) {
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.corner_map = {-1.25, 0.1};
  grid.width = 3;
  grid.height = 2;
  grid.cells = {Cell::kOccupied, Cell::kFree, Cell::kUnknown, Cell::kFree, Cell::kFree, Cell::kOccupied};
  const test::TemporaryFolder folder;
  writeGrid(grid, folder.path());
  EXPECT_EQ(contents(folder.path() / "grid.pgm"), std::string("P5\n3 2\n255\n\xfe\xfe\0\0\xfe\xcd", 17));
  EXPECT_EQ(contents(folder.path() / "grid.yaml"),
            "image: grid.pgm\nresolution: 0.05\norigin: [-1.2500, 0.1000, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(OccupancyGrid, FullDiskIsAnError) {
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.width = 1000;
  grid.height = 1000;
  grid.cells.assign(1000000, Cell::kFree);
  const test::TemporaryFolder folder;
  const test::FileSizeLimit limit(1000);
  EXPECT_THROW(writeGrid(grid, folder.path()), base::Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "grid.pgm"));
}

}  // namespace
}  // namespace oikos::mapping
