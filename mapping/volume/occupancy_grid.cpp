// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/occupancy_grid.h"

#include <algorithm>
#include <limits>
#include <ostream>

#include "core/base/atomic_file.h"
#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/number_text.h"

namespace oikos::mapping {

namespace {

/// Lowest and highest voxel number per axis among the known voxels.
struct Extent {
  int min_x = std::numeric_limits<int>::max();
  int min_y = std::numeric_limits<int>::max();
  int max_x = std::numeric_limits<int>::min();
  int max_y = std::numeric_limits<int>::min();
};

Extent findExtent(const OccupancyIntegrator& occupancy) {
  Extent extent;
  occupancy.forEachVoxel([&](VoxelKey key, float) {
    const auto numbers = unpackVoxelKey(key);
    extent.min_x = std::min(extent.min_x, int{numbers[0]});
    extent.max_x = std::max(extent.max_x, int{numbers[0]});
    extent.min_y = std::min(extent.min_y, int{numbers[1]});
    extent.max_y = std::max(extent.max_y, int{numbers[1]});
  });
  return extent.min_x > extent.max_x ? Extent{kVoxelKeyOrigin, kVoxelKeyOrigin, kVoxelKeyOrigin, kVoxelKeyOrigin} : extent;
}

struct Column {
  int occupied = 0;
  bool seen_low = false;
};

Cell judge(const Column& column, const OccupancyGridConfig& config) {
  if (column.occupied >= config.min_occupied_voxels) {
    return Cell::kOccupied;
  }
  return column.seen_low && column.occupied == 0 ? Cell::kFree : Cell::kUnknown;
}

}  // namespace

std::vector<std::string> OccupancyGridConfig::validate() const {
  base::ConfigRules rules;
  rules.atLeast("floor_clearance_m", floor_clearance_m, 0.0).greater("robot_height_m", robot_height_m, floor_clearance_m);
  rules.greater("free_below_m", free_below_m, floor_clearance_m).atLeast("min_occupied_voxels", min_occupied_voxels, 1);
  return rules.messages();
}

OccupancyGrid projectOccupancy(const OccupancyIntegrator& occupancy, const OccupancyGridConfig& config) {
  OIKOS_CHECK(config.validate().empty());
  const Extent extent = findExtent(occupancy);
  const double resolution_m = occupancy.config().resolution_m;
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.corner_map = resolution_m * Eigen::Vector2d(extent.min_x - kVoxelKeyOrigin, extent.min_y - kVoxelKeyOrigin);
  grid.width = extent.max_x - extent.min_x + 1;
  grid.height = extent.max_y - extent.min_y + 1;
  std::vector<Column> columns(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  occupancy.forEachVoxel([&](VoxelKey key, float log_odds) {
    const auto numbers = unpackVoxelKey(key);
    const double z_m = occupancy.lattice().center(numbers[2]);
    if (z_m < config.floor_clearance_m || z_m > config.robot_height_m) {
      return;
    }
    const int place = (numbers[1] - extent.min_y) * grid.width + numbers[0] - extent.min_x;
    Column& column = columns[static_cast<std::size_t>(place)];
    if (occupancy.isOccupied(log_odds)) {
      ++column.occupied;
    } else if (z_m < config.free_below_m) {
      column.seen_low = true;
    }
  });
  grid.cells.resize(columns.size());
  std::transform(columns.begin(), columns.end(), grid.cells.begin(), [&](const Column& column) { return judge(column, config); });
  return grid;
}

OccupancyGrid withAllUnknown(OccupancyGrid grid) {
  std::fill(grid.cells.begin(), grid.cells.end(), Cell::kUnknown);
  return grid;
}

void writeGrid(const OccupancyGrid& grid, const std::filesystem::path& folder) {
  base::AtomicFile image(folder / "grid.pgm");
  image.stream() << "P5\n" << std::to_string(grid.width) << ' ' << std::to_string(grid.height) << "\n255\n";
  for (int row = grid.height - 1; row >= 0; --row) {
    for (int column = 0; column < grid.width; ++column) {
      image.stream().put(static_cast<char>(grid.at(column, row)));
    }
  }
  base::AtomicFile description(folder / "grid.yaml");
  description.stream() << "image: grid.pgm\nresolution: " << base::toText(grid.resolution_m) << "\norigin: ["
                       << base::toFixedText(grid.corner_map.x(), 4) << ", " << base::toFixedText(grid.corner_map.y(), 4)
                       << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  image.commit();
  description.commit();
}

}  // namespace oikos::mapping
