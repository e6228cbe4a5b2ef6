// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/revision_config.h"

#include "core/base/config_rules.h"

namespace oikos::mapping {

std::vector<std::string> RevisionConfig::validate() const {
  base::ConfigRules rules;
  rules.greater("view_step_m", view_step_m, 0.0);
  rules.require(view_step_deg > 0.0 && view_step_deg <= 180.0, "view_step_deg", view_step_deg, "must be > 0 and <= 180");
  rules.between("known_share", known_share, 0.0, 1.0);
  rules.require(like_view_deg > 0.0 && like_view_deg <= 180.0, "like_view_deg", like_view_deg, "must be > 0 and <= 180");
  rules.atLeast("pose_sigma_m", pose_sigma_m, 0.0)
      .atLeast("pose_sigma_deg", pose_sigma_deg, 0.0)
      .atLeast("witnesses", witnesses, 1)
      .atLeast("min_gain_voxels", min_gain_voxels, 1);
  return rules.messages();
}

}  // namespace oikos::mapping
