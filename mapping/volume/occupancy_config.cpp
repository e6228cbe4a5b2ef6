// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/occupancy_config.h"

#include "core/base/config_rules.h"

namespace oikos::mapping {

std::vector<std::string> OccupancyConfig::validate() const {
  base::ConfigRules rules;
  rules.between("resolution_m", resolution_m, 0.01, 0.1).atLeast("min_range_m", min_range_m, 0.0);
  rules.require(max_range_m > min_range_m && max_range_m <= 100.0, "max_range_m", max_range_m, "must be > min_range_m and <= 100");
  rules.require(probability_hit >= 0.5 && probability_hit < 1.0, "probability_hit", probability_hit, "must be >= 0.5 and < 1");
  rules.require(probability_miss > 0.0 && probability_miss <= 0.5, "probability_miss", probability_miss, "must be > 0 and <= 0.5");
  rules.require(probability_min > 0.0 && probability_min < 0.5, "probability_min", probability_min, "must be > 0 and < 0.5");
  rules.require(probability_max > 0.5 && probability_max < 1.0, "probability_max", probability_max, "must be > 0.5 and < 1");
  rules.between("occupied_threshold", occupied_threshold, probability_min, probability_max);
  rules.between("pixel_stride", pixel_stride, 1, 64);
  return rules.messages();
}

}  // namespace oikos::mapping
