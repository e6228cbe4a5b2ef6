// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/relations.h"

#include <cmath>
#include <set>

#include "semantic/model/placement.h"

namespace oikos::semantic {

namespace {

SpatialRelation toSpatial(Relation relation) {
  switch (relation) {
    case Relation::kOn:
      return SpatialRelation::kOn;
    case Relation::kIn:
      return SpatialRelation::kIn;
    case Relation::kUnder:
      break;
  }
  return SpatialRelation::kUnder;
}

}  // namespace

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

double distanceTo(const Box& box, const Eigen::Vector3d& point_carrier) {
  const Eigen::Vector3d point_box = box.center.toIsometry().inverse() * point_carrier;
  return (point_box.cwiseAbs() - box.size_m / 2.0).cwiseMax(0.0).norm();
}

std::vector<SpatialRelation> spatialRelations(std::span<const Box> carrier, const Eigen::Isometry3d& T_carrier_object,
                                              const std::optional<Box>& object_box) {
  const Eigen::Vector3d middle = T_carrier_object * (object_box ? object_box->center.position_m : Eigen::Vector3d::Zero());
  std::set<SpatialRelation> relations;
  bool is_near = false;
  for (const Box& box : carrier) {
    if (const auto relation = findRelation(box, T_carrier_object, object_box)) {
      relations.insert(toSpatial(*relation));
    }
    is_near = is_near || distanceTo(box, middle) <= kNear_m;
  }
  if (relations.empty() && is_near) {
    relations.insert(SpatialRelation::kNear);
  }
  return {relations.begin(), relations.end()};
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
