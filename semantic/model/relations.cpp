// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/relations.h"

#include <cmath>

#include "semantic/model/placement.h"

namespace oikos::semantic {

std::optional<Relation> findRelation(const Box& carrier, const Eigen::Isometry3d& T_carrier_object, const std::optional<Box>& object_box) {
  const Eigen::Isometry3d T_box_object = carrier.center.toIsometry().inverse() * T_carrier_object;
  const Eigen::Vector3d middle = T_box_object * (object_box ? object_box->center.position_m : Eigen::Vector3d::Zero());
  const double foot_m = middle.z() - (object_box ? object_box->size_m.z() / 2.0 : 0.0);
  const Eigen::Vector3d half = carrier.size_m / 2.0;
  if (std::abs(middle.x()) > half.x() || std::abs(middle.y()) > half.y()) {
    return std::nullopt;
  }
  if (std::abs(foot_m - half.z()) <= kTouch_m) {
    return Relation::kOn;
  }
  if (std::abs(middle.z()) <= half.z()) {
    return Relation::kIn;
  }
  return middle.z() < 0.0 ? std::optional(Relation::kUnder) : std::nullopt;
}

std::vector<Box> boxesOf(const LargeObject& object, std::string_view parent) {
  std::vector<Box> boxes;
  if (parent == object.id.value) {
    boxes = object.boxes_object;
  }
  if (!object.articulation) {
    return boxes;
  }
  for (const Part& part : object.articulation->parts) {
    const auto T_object_part = findPartInObject(*object.articulation, part.id);
    if (part.id.value == parent) {
      boxes.insert(boxes.end(), part.boxes_part.begin(), part.boxes_part.end());
    } else if (parent == object.id.value && T_object_part) {
      for (const Box& box : part.boxes_part) {
        boxes.push_back({Pose::fromIsometry(*T_object_part * box.center.toIsometry()), box.size_m});
      }
    }
  }
  return boxes;
}

}  // namespace oikos::semantic
