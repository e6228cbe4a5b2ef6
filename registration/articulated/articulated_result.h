// SPDX-License-Identifier: Apache-2.0
// What one image says of a piece and of its doors and drawers.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "core/geometry/se3.h"
#include "registration/articulated/joint_decision.h"
#include "registration/articulated/joint_equations.h"

namespace oikos::registration {

enum class BaseStatus {
  kNotInView,   ///< nothing of it is before a reading: it is where it was believed to be, as far as the doors do not say more
  kNotThere,    ///< the readings do not fit it: it has been moved farther than can be told, or is another piece
  kRegistered,  ///< S228
};
constexpr auto enumTable(BaseStatus) {
  return std::to_array<base::EnumName<BaseStatus>>(
      {{BaseStatus::kNotInView, "not in view"}, {BaseStatus::kNotThere, "not there"}, {BaseStatus::kRegistered, "registered"}});
}

/// One door, drawer or lid.
struct JointEstimate {
  int joint = 0;     ///< index in the model
  std::string name;  ///< the joint's
  JointStatus status = JointStatus::kNotInView;
  double value = 0.0;       ///< rad or m, within the limits; of a joint that was not found: the best guess, with its variance
  double variance = 0.0;    ///< rad^2 or m^2
  double confidence = 0.0;  ///< that no other value explains the image
  Eigen::Isometry3d T_parent_part = Eigen::Isometry3d::Identity();  ///< of the joint's child (S233)
  Eigen::Isometry3d T_map_part = Eigen::Isometry3d::Identity();
  JointEvidence evidence;
  JointSight sight;
};

struct [[nodiscard]] ArticulatedResult {
  BaseStatus status = BaseStatus::kNotInView;
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();  ///< the base, registered again
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of its right perturbation (m, rad); where nothing is seen: its prior's
  LinkCounts base_counts;
  double rms_m = 0.0;                         ///< of all that agrees, from the surfaces
  std::vector<JointEstimate> joints;          ///< parents before children; knobs and fixed joints have none
  std::vector<double> joint_values;           ///< one a joint of the model
  std::vector<Eigen::Isometry3d> T_map_part;  ///< one a part of the model: children are carried along (S234, S235)

  [[nodiscard]] const JointEstimate* find(const std::string& joint_name) const;
};

}  // namespace oikos::registration
