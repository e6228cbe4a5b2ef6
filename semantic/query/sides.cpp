// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/sides.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace oikos::semantic {

namespace {

constexpr double kBeside_m = 3.0;
constexpr double kNextTo_m = 1.0;

/// Of the furniture that both belong to, or of the thing itself.
Eigen::Isometry3d frontInMap(const Thing& thing) {
  return thing.object != nullptr ? thing.object->T_map_object.toIsometry() : thing.T_map_thing();
}

}  // namespace

bool isBeside(const Thing& thing, PlaceRelation relation, const Thing& other) {
  const bool same_furniture = thing.object != nullptr && other.object != nullptr && thing.object->id == other.object->id &&
                              (thing.kind != ThingKind::kSmallObject || other.kind != ThingKind::kSmallObject);
  if (thing.room->id != other.room->id || thing.id() == other.id() || other.kind == ThingKind::kRoom || same_furniture) {
    return false;
  }
  if (relation == PlaceRelation::kNear) {
    return distanceBetween(thing, other) <= kNextTo_m;
  }
  const Eigen::Vector3d offset = frontInMap(other).inverse() * thing.middle_map() - frontInMap(other).inverse() * other.middle_map();
  if (offset.head<2>().norm() > kBeside_m) {
    return false;
  }
  switch (relation) {
    case PlaceRelation::kLeftOf:
      return offset.y() < 0.0 && std::abs(offset.y()) >= std::abs(offset.x());
    case PlaceRelation::kRightOf:
      return offset.y() > 0.0 && std::abs(offset.y()) >= std::abs(offset.x());
    case PlaceRelation::kInFrontOf:
      return offset.x() > 0.0 && std::abs(offset.x()) >= std::abs(offset.y());
    case PlaceRelation::kBehind:
      return offset.x() < 0.0 && std::abs(offset.x()) >= std::abs(offset.y());
    case PlaceRelation::kAbove:
      return offset.z() > 0.0 && offset.head<2>().norm() < kNextTo_m;
    default:
      return false;
  }
}

std::vector<const Thing*> pickBySide(const std::vector<const Thing*>& things, bool left) {
  std::map<std::string, std::pair<double, const Thing*>> outermost;  // by furniture
  for (const Thing* thing : things) {
    if (thing->object == nullptr) {
      continue;
    }
    const double y = (frontInMap(*thing).inverse() * thing->middle_map()).y();
    const double key = left ? y : -y;
    const auto [entry, first] = outermost.try_emplace(thing->object->id.value, key, thing);
    if (!first && key < entry->second.first) {
      entry->second = {key, thing};
    }
  }
  std::vector<const Thing*> picked;
  std::copy_if(things.begin(), things.end(), std::back_inserter(picked),
               [&](const Thing* thing) { return thing->object != nullptr && outermost.at(thing->object->id.value).second == thing; });
  return picked;
}

}  // namespace oikos::semantic
