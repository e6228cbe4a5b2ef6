// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/occupancy_config.h"

#include "mapping/volume/config_check.h"

namespace oikos::mapping {

std::vector<std::string> OccupancyConfig::validate() const {
  ConfigCheck check("occupancy");
  check.require(resolution_m >= 0.01 && resolution_m <= 0.1, "resolution_m", resolution_m, "must be 0.01 to 0.1");
  check.require(min_range_m >= 0.0, "min_range_m", min_range_m, "must be >= 0");
  check.require(max_range_m > min_range_m && max_range_m <= 100.0, "max_range_m", max_range_m, "must be > min_range_m and <= 100");
  check.require(probability_hit >= 0.5 && probability_hit < 1.0, "probability_hit", probability_hit, "must be >= 0.5 and < 1");
  check.require(probability_miss > 0.0 && probability_miss <= 0.5, "probability_miss", probability_miss, "must be > 0 and <= 0.5");
  check.require(probability_min > 0.0 && probability_min < 0.5, "probability_min", probability_min, "must be > 0 and < 0.5");
  check.require(probability_max > 0.5 && probability_max < 1.0, "probability_max", probability_max, "must be > 0.5 and < 1");
  check.require(occupied_threshold >= probability_min && occupied_threshold <= probability_max, "occupied_threshold", occupied_threshold,
                "must lie between probability_min and probability_max");
  check.require(pixel_stride >= 1 && pixel_stride <= 64, "pixel_stride", pixel_stride, "must be 1 to 64");
  check.require(threads >= 1, "threads", threads, "must be >= 1");
  return check.complaints();
}

}  // namespace oikos::mapping
