// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/state_config.h"

#include "core/base/config_rules.h"

namespace oikos::tracking {

std::vector<std::string> FrameChoiceConfig::validate() const {
  return base::ConfigRules()
      .greater("most_hz", most_hz, 0.0)
      .atLeast("step_px", step_px, 1)
      .atLeast("min_pixels", min_pixels, 1)
      .greater("max_range_m", max_range_m, 0.0)
      .greater("max_pose_sigma_m", max_pose_sigma_m, 0.0)
      .greater("max_pose_sigma_deg", max_pose_sigma_deg, 0.0)
      .greater("gap_s", gap_s, 0.0)
      .atLeast("spacing_s", spacing_s, 0.0)
      .atLeast("most_frames", most_frames, 1)
      .between("reach_weight", reach_weight, 0.0, 1.0)
      .between("whole_weight", whole_weight, 0.0, 1.0)
      .atLeast("most_halvings", most_halvings, 0)
      .messages();
}

std::vector<std::string> PlacementConfig::validate() const {
  return base::ConfigRules()
      .greater("fixed_sigma_m", fixed_sigma_m, 0.0)
      .greater("fixed_sigma_deg", fixed_sigma_deg, 0.0)
      .greater("shiftable_sigma_m", shiftable_sigma_m, 0.0)
      .greater("shiftable_sigma_deg", shiftable_sigma_deg, 0.0)
      .messages();
}

std::vector<std::string> ChangeTestConfig::validate() const {
  return base::ConfigRules()
      .greater("significance", significance, 0.0)
      .atLeast("believed_sigma_deg", believed_sigma_deg, 0.0)
      .atLeast("believed_sigma_m", believed_sigma_m, 0.0)
      .atLeast("min_change_deg", min_change_deg, 0.0)
      .atLeast("min_change_m", min_change_m, 0.0)
      .atLeast("closed_deg", closed_deg, 0.0)
      .atLeast("closed_m", closed_m, 0.0)
      .atLeast("min_images", min_images, 1)
      .messages();
}

}  // namespace oikos::tracking
