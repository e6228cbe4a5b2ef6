// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/object_config.h"

#include "core/base/config_rules.h"

namespace oikos::tracking {

std::vector<std::string> ObjectViewConfig::validate() const {
  return base::ConfigRules()
      .atLeast("spacing_s", spacing_s, 0.0)
      .greater("max_range_m", max_range_m, 0.0)
      .atLeast("min_pixels", min_pixels, 1)
      .atLeast("min_side_px", min_side_px, 0.0)
      .between("min_shown", min_shown, 0.0, 1.0)
      .atLeast("apart_m", apart_m, 0.0)
      .atLeast("first_views", first_views, 1)
      .atLeast("more_views", more_views, 0)
      .atLeast("most_views", most_views, first_views)
      .between("min_worth", min_worth, 0.0, 1.0)
      .atLeast("read_anyway", read_anyway, 1.0)
      .atLeast("later_s", later_s, 0.0)
      .messages();
}

std::vector<std::string> ObjectSightConfig::validate() const {
  return base::ConfigRules()
      .greater("sigmas", sigmas, 0.0)
      .atLeast("object_sigma_m", object_sigma_m, 0.0)
      .atLeast("fixed_sigma_m", fixed_sigma_m, 0.0)
      .atLeast("carried_sigma_m", carried_sigma_m, 0.0)
      .atLeast("height_sigma_m", height_sigma_m, 0.0)
      .greater("max_sigma_m", max_sigma_m, 0.0)
      .between("min_facing", min_facing, 0.01, 1.0)
      .atLeast("near_m", near_m, 0.0)
      .atLeast("above_carrier_m", above_carrier_m, 0.0)
      .between("max_missing", max_missing, 0.0, 1.0)
      .between("max_hidden", max_hidden, 0.0, 1.0)
      .between("min_telling", min_telling, 0.0, 1.0)
      .atLeast("min_telling_pixels", min_telling_pixels, 1)
      .between("min_through", min_through, 0.5, 1.0)
      .atLeast("max_matter", max_matter, 0.0)
      .atLeast("min_matter", min_matter, max_matter)
      .between("min_carrier", min_carrier, 0.0, 1.0)
      .atLeast("min_carrier_pixels", min_carrier_pixels, 1)
      .between("max_edge_through", max_edge_through, 0.0, 1.0)
      .atLeast("min_edge_pixels", min_edge_pixels, 1)
      .messages();
}

std::vector<std::string> MissedTestConfig::validate() const {
  return base::ConfigRules()
      .atLeast("min_views", min_views, 2)
      .between("misread", misread, 1e-6, 0.5)
      .between("max_chance", max_chance, 0.0, 1.0)
      .messages();
}

}  // namespace oikos::tracking
