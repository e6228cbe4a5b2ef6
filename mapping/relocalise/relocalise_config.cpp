// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/relocalise_config.h"

#include "core/base/config_rules.h"

namespace oikos::mapping {

std::vector<std::string> RelocaliseConfig::validate() const {
  base::ConfigRules rules;
  rules.between("pyramid_levels", pyramid_levels, 1, 10)
      .atLeast("candidates", candidates, 1)
      .atLeast("min_votes", min_votes, 1)
      .atLeast("local_keyframes", local_keyframes, 1)
      .atLeast("most_landmarks", most_landmarks, 30);
  rules.require(max_view_deg > 0.0 && max_view_deg <= 180.0, "max_view_deg", max_view_deg, "must be > 0 and <= 180");
  rules.atLeast("map_sigma_m", map_sigma_m, 0.0).atLeast("map_sigma_deg", map_sigma_deg, 0.0);
  return rules.messages();
}

}  // namespace oikos::mapping
