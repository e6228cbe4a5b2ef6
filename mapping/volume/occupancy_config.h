// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace oikos::mapping {

/// The sensor model of the occupancy map (Hornung et al., "OctoMap", Autonomous Robots 2013, doi:10.1007/s10514-012-9321-0).
struct OccupancyConfig {
  double resolution_m = 0.05;       ///< side of a voxel, 0.01 to 0.1
  double min_range_m = 0.3;         ///< readings nearer to the camera than this are dropped
  double max_range_m = 4.5;         ///< farther readings clear the ray up to here and occupy nothing
  double probability_hit = 0.7;     ///< that a voxel is occupied, given a reading in it
  double probability_miss = 0.4;    ///< that a voxel is occupied, given a ray through it
  double probability_min = 0.1192;  ///< clamping: a voxel never gets surer than this
  double probability_max = 0.971;
  double occupied_threshold = 0.5;  ///< occupied from this probability on
  int pixel_stride = 2;             ///< every n-th pixel of every n-th row makes a ray

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("resolution_m", resolution_m);
    visitor("min_range_m", min_range_m);
    visitor("max_range_m", max_range_m);
    visitor("probability_hit", probability_hit);
    visitor("probability_miss", probability_miss);
    visitor("probability_min", probability_min);
    visitor("probability_max", probability_max);
    visitor("occupied_threshold", occupied_threshold);
    visitor("pixel_stride", pixel_stride);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::mapping
