// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mapping/volume/occupancy_integrator.h"

namespace oikos::mapping {

struct OccupancyGridConfig {
  double floor_clearance_m = 0.1;  ///< what is lower than this is floor, not obstacle
  double robot_height_m = 1.5;     ///< what is higher than this the robot passes under
  double free_below_m = 0.6;       ///< a cell is free only where the air was seen at some height below this too
  int min_occupied_voxels = 1;     ///< occupied voxels in the column that make a cell occupied

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("floor_clearance_m", floor_clearance_m);
    visitor("robot_height_m", robot_height_m);
    visitor("free_below_m", free_below_m);
    visitor("min_occupied_voxels", min_occupied_voxels);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// The values are map_server's grey levels.
enum class Cell : std::uint8_t { kOccupied = 0, kUnknown = 205, kFree = 254 };

/// A map seen from above: row 0 is the lowest y, column 0 the lowest x.
struct OccupancyGrid {
  double resolution_m = 0.0;
  Eigen::Vector2d corner_map = Eigen::Vector2d::Zero();  ///< outer corner of cell (0, 0)
  int width = 0;
  int height = 0;
  std::vector<Cell> cells;

  [[nodiscard]] Cell at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

/// Projects the voxels between floor clearance and robot height straight down; the cells are the voxels' columns. Occupied: an
/// occupied voxel in the column. Free: none, and a ray passed below `free_below_m`. Unknown: the rest. The integrator's frame
/// must have z up and the floor at z = 0.
[[nodiscard]] OccupancyGrid projectOccupancy(const OccupancyIntegrator& occupancy, const OccupancyGridConfig& config);

/// The same extent with every cell unknown: where no floor was found, nothing is known to be passable.
[[nodiscard]] OccupancyGrid withAllUnknown(OccupancyGrid grid);

/// Writes `grid.pgm` and `grid.yaml` (ROS map_server's format) into an existing folder; each is atomic; throws Error{kIo}.
void writeGrid(const OccupancyGrid& grid, const std::filesystem::path& folder);

}  // namespace oikos::mapping
