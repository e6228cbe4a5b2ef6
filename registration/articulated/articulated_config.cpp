// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/articulated_config.h"

#include "core/base/config_rules.h"

namespace oikos::registration {

std::vector<std::string> ArticulatedConfig::validate() const {
  return base::ConfigRules()
      .greater("stride_m", stride_m, 0.0)
      .atLeast("coarse_thinning", coarse_thinning, 1)
      .greater("coarse_sigma_m", coarse_sigma_m, 0.0)
      .greater("fine_sigma_m", fine_sigma_m, 0.0)
      .require(profile_tempering > 0.0 && profile_tempering <= 1.0, "profile_tempering", profile_tempering, "must be > 0 and <= 1")
      .atLeast("min_base_pixels", min_base_pixels, 1)
      .between("min_base_share", min_base_share, 0.0, 1.0)
      .greater("max_unseen_off", max_unseen_off, 0.0)
      .atLeast("most_rivals", most_rivals, 1)
      .between("rival_share", rival_share, 0.0, 1.0)
      .greater("unlimited_m", unlimited_m, 0.0)
      .atLeast("threads", threads, 1)
      .messages();
}

}  // namespace oikos::registration
