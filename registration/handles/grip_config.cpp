// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/grip_config.h"

#include "core/base/config_rules.h"

namespace oikos::registration {

std::vector<std::string> GripConfig::validate() const {
  return base::ConfigRules()
      .greater("place_sigma_m", place_sigma_m, 0.0)
      .greater("height_sigma_m", height_sigma_m, 0.0)
      .greater("roll_sigma_deg", roll_sigma_deg, 0.0)
      .greater("length_sigma_m", length_sigma_m, 0.0)
      .atLeast("mixture_sigma_m", mixture_sigma_m, 0.0)
      .greater("bar_radius_m", bar_radius_m, 0.0)
      .greater("radius_sigma_m", radius_sigma_m, 0.0)
      .greater("bar_length_m", bar_length_m, 0.0)
      .greater("knob_width_m", knob_width_m, 0.0)
      .greater("search_m", search_m, 0.0)
      .atLeast("min_reach_m", min_reach_m, 0.0)
      .greater("max_reach_m", max_reach_m, min_reach_m)
      .greater("offset_sigma_m", offset_sigma_m, 0.0)
      .greater("sharp_blur_px", sharp_blur_px, 0.0)
      .greater("wide_blur_px", wide_blur_px, 0.0)
      .greater("correlation_px", correlation_px, 0.0)
      .atLeast("floor_m", floor_m, 0.0)
      .greater("noise_floor_m", noise_floor_m, 0.0)
      .atLeast("most_readings", most_readings, 100)
      .atLeast("min_readings", min_readings, 1)
      .between("max_hidden", max_hidden, 0.0, 1.0)
      .greater("min_gain", min_gain, 0.0)
      .greater("apart_m", apart_m, 0.0)
      .atLeast("most_places", most_places, 1)
      .messages();
}

}  // namespace oikos::registration
