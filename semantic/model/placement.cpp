// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/placement.h"

#include <algorithm>

namespace oikos::semantic {

Eigen::Isometry3d jointMotion(const Joint& joint) {
  Eigen::Isometry3d T_joint_child = Eigen::Isometry3d::Identity();
  if (joint.type == JointType::kRevolute) {
    T_joint_child.linear() = Eigen::AngleAxisd(joint.value, joint.axis_joint.normalized()).toRotationMatrix();
  } else {
    T_joint_child.translation() = joint.value * joint.axis_joint.normalized();
  }
  return T_joint_child;
}

std::optional<Eigen::Isometry3d> findPartInObject(const Articulation& articulation, const PartId& part) {
  Eigen::Isometry3d T_ancestor_part = Eigen::Isometry3d::Identity();
  PartId current = part;
  for (std::size_t steps = 0; steps <= articulation.parts.size(); ++steps) {
    const auto found = std::find_if(articulation.parts.begin(), articulation.parts.end(), [&](const Part& p) { return p.id == current; });
    if (found == articulation.parts.end()) {
      return std::nullopt;
    }
    if (found->parent.value.empty()) {
      return T_ancestor_part;
    }
    const auto joint =
        std::find_if(articulation.joints.begin(), articulation.joints.end(), [&](const Joint& j) { return j.child == current; });
    if (joint != articulation.joints.end()) {
      T_ancestor_part = joint->T_parent_joint.toIsometry() * jointMotion(*joint) * T_ancestor_part;
    }
    current = found->parent;
  }
  return std::nullopt;  // a circle
}

std::optional<Eigen::Isometry3d> findCarrierInMap(const LargeObject& object, std::string_view parent) {
  if (parent == object.id.value) {
    return object.T_map_object.toIsometry();
  }
  if (!object.articulation) {
    return std::nullopt;
  }
  const auto T_object_part = findPartInObject(*object.articulation, PartId{std::string(parent)});
  return T_object_part ? std::optional(object.T_map_object.toIsometry() * *T_object_part) : std::nullopt;
}

}  // namespace oikos::semantic
