// SPDX-License-Identifier: Apache-2.0
// The rules of this folder's configurations in one place.
#include "core/base/config_rules.h"
#include "mapping/graph/bundle_adjustment.h"
#include "mapping/graph/covisibility.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/loop_consistency.h"
#include "mapping/graph/pose_graph.h"

namespace oikos::mapping {

std::vector<std::string> FrontEndConfig::validate() const {
  base::ConfigRules rules;
  rules.between("pyramid_levels", pyramid_levels, 1, 10).between("keyframe_overlap", keyframe_overlap, 0.0, 1.0);
  rules.require(keyframe_rotation_deg > 0.0 && keyframe_rotation_deg <= 180.0, "keyframe_rotation_deg", keyframe_rotation_deg,
                "must be > 0 and <= 180");
  rules.greater("keyframe_parallax", keyframe_parallax, 0.0)
      .atLeast("neighbourhood", neighbourhood, 0)
      .greater("borrow_gain", borrow_gain, 0.0)
      .atLeast("frames_a_look", frames_a_look, 1)
      .atLeast("local_keyframes", local_keyframes, 1)
      .atLeast("loop_candidates", loop_candidates, 0)
      .atLeast("min_loop_votes", min_loop_votes, 1)
      .between("reuse_overlap", reuse_overlap, 0.0, 1.0)
      .atLeast("settled_views", settled_views, 1)
      .between("settled_share", settled_share, 0.0, 1.0)
      .atLeast("kept_sightings", kept_sightings, 30)
      .atLeast("max_lost_frames", max_lost_frames, 0);
  return rules.messages();
}

std::vector<std::string> LoopConsistencyConfig::validate() const {
  return base::ConfigRules()
      .greater("drift_m_per_edge", drift_m_per_edge, 0.0)
      .greater("drift_rad_per_edge", drift_rad_per_edge, 0.0)
      .greater("loop_sigma_m", loop_sigma_m, 0.0)
      .greater("loop_sigma_rad", loop_sigma_rad, 0.0)
      .greater("gate_sigmas", gate_sigmas, 0.0)
      .greater("look_alike_sigmas", look_alike_sigmas, 0.0)
      .messages();
}

std::vector<std::string> PoseGraphConfig::validate() const {
  return base::ConfigRules()
      .atLeast("max_iterations", max_iterations, 1)
      .greater("information_scale", information_scale, 0.0)
      .greater("max_information", max_information, 0.0)
      .greater("cauchy_sigmas", cauchy_sigmas, 0.0)
      .greater("odometry_sigma_m", odometry_sigma_m, 0.0)
      .greater("odometry_sigma_rad", odometry_sigma_rad, 0.0)
      .atLeast("odometry_drift", odometry_drift, 0.0)
      .messages();
}

std::vector<std::string> CovisibilityConfig::validate() const {
  base::ConfigRules rules;
  rules.atLeast("max_partners", max_partners, 0).atLeast("min_expected", min_expected, 0).atLeast("max_sightings", max_sightings, 1);
  rules.require(max_view_deg > 0.0 && max_view_deg <= 180.0, "max_view_deg", max_view_deg, "must be > 0 and <= 180");
  rules.greater("gate_px", gate_px, 0.0);
  return rules.messages();
}

std::vector<std::string> BundleAdjustmentConfig::validate() const {
  return base::ConfigRules()
      .atLeast("max_iterations", max_iterations, 1)
      .greater("pixel_sigma_px", pixel_sigma_px, 0.0)
      .greater("cauchy_sigmas", cauchy_sigmas, 0.0)
      .atLeast("host_depth_weight", host_depth_weight, 0.0)
      .atLeast("sighting_depth_weight", sighting_depth_weight, 0.0)
      .greater("readout_sigma_s", readout_sigma_s, 0.0)
      .greater("settled_sigma_m", settled_sigma_m, 0.0)
      .greater("settled_sigma_rad", settled_sigma_rad, 0.0)
      .greater("function_tolerance", function_tolerance, 0.0)
      .messages();
}

}  // namespace oikos::mapping
