// SPDX-License-Identifier: Apache-2.0
// What many images say about one joint: its value, and when it changed.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "registration/articulated/joint_decision.h"

namespace oikos::registration {

struct JointFusionConfig {
  JointDecisionConfig decision;
  double repeated = 0.2;        ///< share of what an image says that another one from the same place repeats
  double same_view_m = 0.10;    ///< two cameras nearer to each other than this,
  double same_view_deg = 5.0;   ///< and turned by less, stand in the same place
  double misread = 0.01;        ///< chance that an image that has found the joint is wrong,
  double misread_unsure = 0.3;  ///< and that one is that has not
  double change_cost = 8.0;     ///< log odds against a change from one image to the next
  double bin_deg = 0.25;
  double bin_m = 0.002;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("decision", decision);
    visitor("repeated", repeated);
    visitor("same_view_m", same_view_m);
    visitor("same_view_deg", same_view_deg);
    visitor("misread", misread);
    visitor("misread_unsure", misread_unsure);
    visitor("change_cost", change_cost);
    visitor("bin_deg", bin_deg);
    visitor("bin_m", bin_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// One image's word on the joint.
struct JointSighting {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  JointStatus status = JointStatus::kNotInView;
  double confidence = 0.0;
  JointEvidence evidence;
};

/// A time in which the joint stood still.
struct JointSpan {
  std::size_t first = 0;  ///< indices of sightings, both included; the change lies between one span's last and the next one's first
  std::size_t last = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  JointStatus status = JointStatus::kNotInView;
  double value = 0.0;     ///< rad or m
  double variance = 0.0;  ///< rad^2 or m^2
  double confidence = 0.0;
};

/// Sightings of one joint in order of time, all over the same values, split where a change explains them better than standing still does,
/// and fused in between; a span none of whose images has found the joint, or a few values of it, has not found it either. A joint that
/// moves slowly comes out as many short spans. Sightings that do not see the joint are left out; none: no span. Time O(n^2 * bins). Throws
/// ContractViolation for a configuration that is not valid, sightings out of order or of other values.
[[nodiscard]] std::vector<JointSpan> fuse(const std::vector<JointSighting>& sightings, const JointFusionConfig& config);

}  // namespace oikos::registration
