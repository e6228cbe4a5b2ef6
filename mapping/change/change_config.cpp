// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/change_config.h"

#include "core/base/config_rules.h"

namespace oikos::mapping {

std::vector<std::string> FreeSpaceConfig::validate() const {
  base::ConfigRules rules;
  rules.between("min_views", min_views, 1, 255).between("min_view_angle_rad", min_view_angle_rad, 0.0, 1.5);
  rules.require(max_free_probability > 0.0 && max_free_probability < 0.5, "max_free_probability", max_free_probability,
                "must be > 0 and < 0.5");
  rules.require(min_occupied_probability >= 0.5 && min_occupied_probability < 1.0, "min_occupied_probability", min_occupied_probability,
                "must be >= 0.5 and < 1");
  return rules.messages();
}

std::vector<std::string> ChangeConfig::validate() const {
  base::ConfigRules rules;
  rules.between("sigmas", sigmas, 1.0, 10.0).atLeast("map_sigma_m", map_sigma_m, 0.0).atLeast("depth_sigma_1m", depth_sigma_1m, 0.0);
  rules.between("max_tolerance_m", max_tolerance_m, 0.05, 0.5);
  rules.between("pixel_stride", pixel_stride, 1, 64).atLeast("min_points", min_points, 1);
  rules.between("max_missing_share", max_missing_share, 0.0, 1.0).between("min_agreement", min_agreement, 0.0, 1.0);
  rules.between("join_m", join_m, 0.0, 0.5).atLeast("min_seed_voxels", min_seed_voxels, 1).atLeast("min_size_m", min_size_m, 0.0);
  rules.between("min_known_share", min_known_share, 0.0, 1.0).between("max_changed_share", max_changed_share, 0.0, 1.0);
  rules.atLeast("threads", threads, 1);
  return rules.messages();
}

}  // namespace oikos::mapping
