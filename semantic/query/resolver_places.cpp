// SPDX-License-Identifier: Apache-2.0
// What lies in the places that a phrase names.
#include <algorithm>
#include <set>

#include "semantic/query/resolver.h"
#include "semantic/query/sides.h"
#include "semantic/query/whereabouts.h"

namespace oikos::semantic {

namespace {

/// "in the house" is no place: everything is.
bool isHome(const ThingPhrase& phrase) {
  return phrase.words.size() == 1 && phrase.places.empty() &&
         (phrase.words[0] == "house" || phrase.words[0] == "home" || phrase.words[0] == "apartment" || phrase.words[0] == "flat" ||
          phrase.words[0] == "place");
}

bool onlyRooms(const Things& things) {
  return !things.empty() && std::all_of(things.begin(), things.end(), [](const Thing* t) { return t->kind == ThingKind::kRoom; });
}

bool isMovable(const Thing& thing) {
  return thing.kind == ThingKind::kLargeObject || thing.kind == ThingKind::kSmallObject;
}

}  // namespace

bool Resolver::isAt(const Thing& thing, PlaceRelation relation, const Resolution& places) {
  return std::any_of(places.things.begin(), places.things.end(),
                     [&](const Thing* place) { return isIn(thing, relation, *place, places.floor); });
}

bool Resolver::isOfNow(const PlacePhrase& place) const {
  return place.relation == PlaceRelation::kFrom && &present_ != &index_;
}

Resolution Resolver::resolvePlace(const PlacePhrase& place) const {
  return isOfNow(place) ? Resolver(present_, present_, robot_map_).resolvePlace({PlaceRelation::kIn, place.thing, false, {}})
                        : resolve(place.thing);
}

void Resolver::filterByPlace(const PlacePhrase& place, Lookup& lookup, Resolution& resolution) const {
  if (isHome(place.thing) && index_.find(place.thing.words).matches.empty()) {
    const bool inside = place.relation == PlaceRelation::kIn || place.relation == PlaceRelation::kAt;
    if (place.negated || !inside) {
      lookup.matches.clear();
    }
    return;
  }
  if (filterByRoom(place, lookup, resolution)) {
    return;
  }
  const std::vector<PlaceMeant> places = resolveEach(place, resolution);
  const auto is_there = [&](const Thing& thing) {
    return std::any_of(places.begin(), places.end(), [&](const PlaceMeant& p) {
      const Thing* seen = isOfNow(*p.phrase) ? present_.findById(thing.id()) : &thing;
      return seen != nullptr && isAt(*seen, p.phrase->relation, p.places);
    });
  };
  std::erase_if(lookup.matches, [&](const Match& match) { return is_there(index_.thing(match.thing)) == place.negated; });
  const bool beside = place.relation > PlaceRelation::kFrom && !place.negated;
  if (beside) {
    dropPartsOfMatches(lookup);
  }
  const Things& next_to = places.front().places.things;
  if (beside && lookup.matches.size() > 1 && !next_to.empty() && place.relation != PlaceRelation::kNear) {
    keepNextTo(*next_to.front(), lookup);
  }
}

/// The place and those that would do as well, with their unknown words noted.
std::vector<Resolver::PlaceMeant> Resolver::resolveEach(const PlacePhrase& place, Resolution& resolution) const {
  std::vector<PlaceMeant> meant{{&place, resolvePlace(place)}};
  for (const PlacePhrase& other : place.or_at) {
    meant.push_back({&other, resolvePlace(other)});
  }
  for (const PlaceMeant& one : meant) {
    noteWords(one.places, resolution);
    if (one.places.things.empty() && resolution.missing_place.empty()) {
      resolution.missing_place = one.phrase->thing.said;
    }
  }
  return meant;
}

/// What stands beside something is furniture: "the drawers left of the oven" are no single drawers, if a piece is called so.
void Resolver::dropPartsOfMatches(Lookup& lookup) const {
  std::set<const LargeObject*> pieces;
  for (const Match& match : lookup.matches) {
    if (const Thing& thing = index_.thing(match.thing); thing.kind == ThingKind::kLargeObject) {
      pieces.insert(thing.object);
    }
  }
  std::erase_if(lookup.matches, [&](const Match& match) {
    const Thing& thing = index_.thing(match.thing);
    return (thing.kind == ThingKind::kPart || thing.kind == ThingKind::kKnob) && pieces.contains(thing.object);
  });
}

/// A room lies nowhere: "the cup in the kitchen on the table" is on the table. false: the place is no room with further places.
bool Resolver::filterByRoom(const PlacePhrase& place, Lookup& lookup, Resolution& resolution) const {
  if (place.thing.places.empty() || place.negated || !place.or_at.empty()) {
    return false;
  }
  PlacePhrase bare = place;
  bare.thing.places.clear();
  if (!onlyRooms(resolvePlace(bare).things)) {
    return false;
  }
  filterByPlace(bare, lookup, resolution);
  for (const PlacePhrase& further : place.thing.places) {
    filterByPlace(further, lookup, resolution);
  }
  return true;
}

/// "the cupboard left of the fridge" is the next one there.
void Resolver::keepNextTo(const Thing& place, Lookup& lookup) const {
  const auto next = std::min_element(lookup.matches.begin(), lookup.matches.end(), [&](const Match& a, const Match& b) {
    if (a.rank != b.rank) {
      return a.rank < b.rank;
    }
    return distanceBetween(index_.thing(a.thing), place) < distanceBetween(index_.thing(b.thing), place);
  });
  lookup.matches = {*next};
}

void Resolver::filterByPlaces(const ThingPhrase& phrase, Lookup& lookup, Resolution& resolution) const {
  for (const PlacePhrase& place : phrase.places) {
    filterByPlace(place, lookup, resolution);
  }
  resolution.known = resolution.unknown.empty();
}

/// The small objects of the places' furniture.
Lookup Resolver::carriedBy(const Things& places) const {
  Lookup carried;
  for (const Thing* place : places) {
    if (place->object == nullptr) {
      continue;
    }
    for (const SmallObject& small : place->object->small_objects) {
      const Thing* thing = index_.findById(small.id.value);
      if (thing != nullptr && isMovable(*thing)) {
        carried.matches.push_back({index_.numberOf(*thing), 0});
      }
    }
  }
  std::vector<Match>& matches = carried.matches;
  std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) { return a.thing < b.thing; });
  matches.erase(std::unique(matches.begin(), matches.end(), [](const Match& a, const Match& b) { return a.thing == b.thing; }),
                matches.end());
  return carried;
}

/// Furniture and small objects.
Lookup Resolver::everything() const {
  Lookup all;
  for (std::uint32_t i = 0; i < index_.size(); ++i) {
    if (isMovable(index_.thing(i))) {
      all.matches.push_back({i, 0});
    }
  }
  return all;
}

Resolution Resolver::contents(const ThingPhrase& phrase) const {
  const bool plain = phrase.places.size() == 1 && !phrase.places[0].negated && phrase.places[0].or_at.empty();
  const bool narrow = plain && phrase.places[0].relation <= PlaceRelation::kUnder;
  const Things places = narrow ? resolve(phrase.places[0].thing).things : Things();
  Resolution resolution;
  Lookup all = !places.empty() && !onlyRooms(places) ? carriedBy(places) : everything();
  filterByPlaces(phrase, all, resolution);
  keepOpen(phrase, all);
  keepFurniture(phrase, all);
  for (const Match& match : all.matches) {
    resolution.things.push_back(&index_.thing(match.thing));
  }
  if (phrase.nearest) {
    sortByDistance(phrase, resolution);
  }
  return resolution;
}

}  // namespace oikos::semantic
