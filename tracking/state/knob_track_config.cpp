// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/knob_track_config.h"

#include "core/base/config_rules.h"

namespace oikos::tracking {

std::vector<std::string> KnobTestConfig::validate() const {
  return base::ConfigRules()
      .between("error_share", error_share, 1e-9, 0.5)
      .between("tempering", tempering, 0.01, 1.0)
      .between("turning_share", turning_share, 1e-9, 0.5)
      .between("min_probability", min_probability, 0.0, 1.0)
      .atLeast("min_images", min_images, 1)
      .messages();
}

std::vector<std::string> KnobTrackConfig::validate() const {
  return base::ConfigRules()
      .greater("hidden_m", hidden_m, 0.0)
      .greater("enough_px", enough_px, 0.0)
      .atLeast("most_frames", most_frames, 1)
      .messages();
}

}  // namespace oikos::tracking
