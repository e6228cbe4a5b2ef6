// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/whereabouts.h"

#include <optional>

#include "semantic/query/sides.h"

namespace oikos::semantic {

namespace {

/// In a shelf is on it, and in anything that cannot be shut; but what is on a table is not in it.
bool isSaidSo(const Thing& thing, Relation said) {
  const Relation stored = thing.small_object->relation;
  if (stored == said || thing.object == nullptr || thing.object->articulation) {
    return stored == said;
  }
  return (stored == Relation::kIn && said == Relation::kOn) ||
         (stored == Relation::kOn && said == Relation::kIn && thing.object->type == "shelf");
}

/// Small objects only: whether it lies on, in or under the place.
bool isCarriedBy(const Thing& thing, const Thing& place, std::optional<Relation> relation) {
  if (thing.kind != ThingKind::kSmallObject || (relation && !isSaidSo(thing, *relation))) {
    return false;
  }
  if (place.kind == ThingKind::kLargeObject) {
    return thing.object != nullptr && thing.object->id == place.object->id;
  }
  return place.kind == ThingKind::kPart && thing.part != nullptr && thing.part->id == place.part->id;
}

std::optional<Relation> storedRelation(PlaceRelation relation) {
  switch (relation) {
    case PlaceRelation::kOn:
      return Relation::kOn;
    case PlaceRelation::kIn:
      return Relation::kIn;
    case PlaceRelation::kUnder:
      return Relation::kUnder;
    default:
      return std::nullopt;
  }
}

}  // namespace

bool isPartOf(const Thing& thing, const Thing& whole) {
  switch (whole.kind) {
    case ThingKind::kRoom:
      return thing.room->id == whole.room->id;
    case ThingKind::kLargeObject:
      return thing.object != nullptr && thing.object->id == whole.object->id && thing.kind != ThingKind::kLargeObject;
    case ThingKind::kPart:
      return thing.part != nullptr && thing.part->id == whole.part->id && thing.kind == ThingKind::kSmallObject;
    default:
      return false;
  }
}

bool isIn(const Thing& thing, PlaceRelation relation, const Thing& place, bool floor) {
  if (&thing == &place || thing.kind == ThingKind::kRoom) {
    return false;
  }
  if (floor) {
    return thing.room->id == place.room->id && thing.kind == ThingKind::kSmallObject && thing.object == nullptr;
  }
  if (relation > PlaceRelation::kFrom) {
    return isBeside(thing, relation, place);
  }
  if (place.kind == ThingKind::kRoom) {
    return relation != PlaceRelation::kUnder && isPartOf(thing, place);
  }
  if (relation == PlaceRelation::kAt || relation == PlaceRelation::kFrom) {
    return isCarriedBy(thing, place, std::nullopt) || isPartOf(thing, place) ||
           (relation == PlaceRelation::kAt && isBeside(thing, PlaceRelation::kNear, place));
  }
  const bool is_part = thing.kind == ThingKind::kPart || thing.kind == ThingKind::kKnob;
  return is_part ? isPartOf(thing, place) : isCarriedBy(thing, place, storedRelation(relation));
}

}  // namespace oikos::semantic
