// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/resolver.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "semantic/query/found_thing.h"
#include "semantic/query/sides.h"

namespace oikos::semantic {

namespace {

std::vector<std::string> flatWords(const ThingPhrase& phrase, bool with_ordinal) {
  std::vector<std::string> words;
  for (const ThingPhrase& whole : phrase.whole) {
    words = flatWords(whole, true);
  }
  if (with_ordinal && phrase.ordinal && !phrase.ordinal->word.empty()) {
    words.push_back(phrase.ordinal->word);
  }
  words.insert(words.end(), phrase.words.begin(), phrase.words.end());
  return words;
}

bool saysSide(const ThingPhrase& phrase) {
  return std::any_of(phrase.words.begin(), phrase.words.end(), [](const std::string& word) { return word == "left" || word == "right"; });
}

bool isFloor(const ThingPhrase& phrase) {
  return phrase.words.size() == 1 && (phrase.words[0] == "floor" || phrase.words[0] == "ground");
}

/// "in the house" is no place: everything is.
bool isHome(const ThingPhrase& phrase) {
  return phrase.words.size() == 1 && (phrase.words[0] == "house" || phrase.words[0] == "home" || phrase.words[0] == "apartment" ||
                                      phrase.words[0] == "flat" || phrase.words[0] == "place");
}

bool onlyRooms(const Things& things) {
  return !things.empty() && std::all_of(things.begin(), things.end(), [](const Thing* t) { return t->kind == ThingKind::kRoom; });
}

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

/// Small objects only: whether it lies on, in or under the place.
bool isCarriedBy(const Thing& thing, const Thing& place, std::optional<Relation> relation) {
  if (thing.kind != ThingKind::kSmallObject || (relation && thing.small_object->relation != *relation)) {
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

/// The n-th by height among the things of one piece of furniture; of each piece its own.
Things pickByHeight(const Things& things, const Ordinal& ordinal) {
  Things picked;
  std::set<const void*> groups;
  for (const Thing* first : things) {
    const void* const group = first->object == nullptr ? static_cast<const void*>(first->room) : first->object;
    if (!groups.insert(group).second) {
      continue;
    }
    std::vector<std::pair<double, const Thing*>> by_height;
    for (const Thing* thing : things) {
      if ((thing->object == nullptr ? static_cast<const void*>(thing->room) : thing->object) == group) {
        by_height.emplace_back(-thing->middle_map().z(), thing);
      }
    }
    std::stable_sort(by_height.begin(), by_height.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::size_t count = by_height.size();
    const auto steps = static_cast<std::size_t>(ordinal.steps);
    const std::size_t at = ordinal.middle ? count / 2 : ordinal.from_bottom ? count - 1 - std::min(steps, count - 1) : steps;
    if (at < count && steps < count) {
      picked.push_back(by_height[at].second);
    }
  }
  return picked;
}

void keep(Lookup& lookup, const HomeIndex& index, const Things& things) {
  std::erase_if(lookup.matches,
                [&](const Match& match) { return std::find(things.begin(), things.end(), &index.thing(match.thing)) == things.end(); });
}

void add(std::vector<std::string>& list, const std::vector<std::string>& more) {
  for (const std::string& text : more) {
    if (std::find(list.begin(), list.end(), text) == list.end()) {
      list.push_back(text);
    }
  }
}

}  // namespace

bool Resolver::isAt(const Thing& thing, PlaceRelation relation, const Resolution& places) {
  return std::any_of(places.things.begin(), places.things.end(),
                     [&](const Thing* place) { return isIn(thing, relation, *place, places.floor); });
}

/// The drawers of a chest of drawers are not the chest.
void Resolver::dropWholes(const ThingPhrase& phrase, Lookup& lookup) const {
  const Resolution wholes = resolve(phrase.whole.front());
  const auto is_whole = [&](const Match& match) {
    return std::find(wholes.things.begin(), wholes.things.end(), &index_.thing(match.thing)) != wholes.things.end();
  };
  if (!std::all_of(lookup.matches.begin(), lookup.matches.end(), is_whole)) {
    std::erase_if(lookup.matches, is_whole);
  }
}

/// All words together first: "left door of the cupboard" is what a cupboard's part is called. Then by their structure: a whole, an ordinal,
/// a side that no label says.
Lookup Resolver::lookUp(const ThingPhrase& phrase) const {
  Lookup flat = index_.find(flatWords(phrase, true));
  if (!phrase.whole.empty() && flat.matches.size() > 1) {
    dropWholes(phrase, flat);
  }
  const bool structured = !phrase.whole.empty() || phrase.ordinal || saysSide(phrase);
  if (!structured || (flat.unknown.empty() && !flat.matches.empty())) {
    return flat;
  }
  ThingPhrase noun = phrase;
  std::erase_if(noun.words, [](const std::string& word) { return word == "left" || word == "right"; });
  noun.whole.clear();
  Lookup lookup = index_.find(flatWords(noun, false));
  if (!phrase.whole.empty()) {
    const Resolution wholes = resolve(phrase.whole.front());
    lookup.unknown.insert(lookup.unknown.end(), wholes.unknown.begin(), wholes.unknown.end());
    std::erase_if(lookup.matches, [&](const Match& match) {
      const Thing& thing = index_.thing(match.thing);
      return std::none_of(wholes.things.begin(), wholes.things.end(), [&](const Thing* whole) { return isPartOf(thing, *whole); });
    });
  }
  if (!lookup.unknown.empty() || lookup.matches.empty()) {
    return flat.unknown.empty() ? flat : lookup;
  }
  Things things;
  for (const std::uint32_t number : lookup.best()) {
    things.push_back(&index_.thing(number));
  }
  if (saysSide(phrase)) {
    const bool left = std::find(phrase.words.begin(), phrase.words.end(), "left") != phrase.words.end();
    things = pickBySide(things, left);
  }
  if (phrase.ordinal) {
    things = pickByHeight(things, *phrase.ordinal);
  }
  keep(lookup, index_, things);
  return lookup;
}

void Resolver::noteWords(const Lookup& lookup, Resolution& resolution) const {
  add(resolution.unknown, lookup.unknown);
  add(resolution.corrected, lookup.corrected);
  resolution.known = resolution.unknown.empty();
}

Resolution Resolver::resolvePlace(const PlacePhrase& place) const {
  const bool of_now = place.relation == PlaceRelation::kFrom && &present_ != &index_;
  return of_now ? Resolver(present_, present_, robot_map_).resolvePlace({PlaceRelation::kIn, place.thing}) : resolve(place.thing);
}

void Resolver::filterByPlace(const PlacePhrase& place, Lookup& lookup, Resolution& resolution) const {
  if (isHome(place.thing) && index_.find(place.thing.words).matches.empty()) {
    return;
  }
  // A room lies nowhere: "the cup in the kitchen on the table" is on the table.
  if (!place.thing.places.empty()) {
    PlacePhrase bare = place;
    bare.thing.places.clear();
    if (onlyRooms(resolvePlace(bare).things)) {
      filterByPlace(bare, lookup, resolution);
      for (const PlacePhrase& further : place.thing.places) {
        filterByPlace(further, lookup, resolution);
      }
      return;
    }
  }
  const Resolution places = resolvePlace(place);
  add(resolution.unknown, places.unknown);
  add(resolution.corrected, places.corrected);
  if (places.things.empty() && resolution.missing_place.empty()) {
    resolution.missing_place = place.thing.said;
  }
  const bool of_now = place.relation == PlaceRelation::kFrom && &present_ != &index_;
  std::erase_if(lookup.matches, [&](const Match& match) {
    const Thing& thing = index_.thing(match.thing);
    const Thing* seen = of_now ? present_.findById(thing.id()) : &thing;
    return seen == nullptr || !isAt(*seen, place.relation, places);
  });
  const bool beside = place.relation > PlaceRelation::kFrom;
  if (beside && lookup.matches.size() > 1 && !places.things.empty() && place.relation != PlaceRelation::kNear) {
    // "the cupboard left of the fridge" is the next one there.
    const auto next = std::min_element(lookup.matches.begin(), lookup.matches.end(), [&](const Match& a, const Match& b) {
      if (a.rank != b.rank) {
        return a.rank < b.rank;
      }
      return distanceBetween(index_.thing(a.thing), *places.things.front()) <
             distanceBetween(index_.thing(b.thing), *places.things.front());
    });
    lookup.matches = {*next};
  }
}

void Resolver::filterByPlaces(const ThingPhrase& phrase, Lookup& lookup, Resolution& resolution) const {
  for (const PlacePhrase& place : phrase.places) {
    filterByPlace(place, lookup, resolution);
  }
  resolution.known = resolution.unknown.empty();
}

void Resolver::keepOpen(const ThingPhrase& phrase, Lookup& lookup) const {
  if (phrase.open) {
    std::erase_if(lookup.matches, [&](const Match& match) {
      const auto open = isOpen(index_.thing(match.thing));
      return !open || *open != *phrase.open;
    });
  }
}

void Resolver::sortByDistance(const ThingPhrase& phrase, Resolution& resolution) const {
  Things to;
  if (!phrase.nearest_to.empty()) {
    const Resolution target = resolve(phrase.nearest_to.front());
    add(resolution.unknown, target.unknown);
    add(resolution.corrected, target.corrected);
    to = target.things;
    std::erase_if(resolution.things, [&](const Thing* thing) { return std::find(to.begin(), to.end(), thing) != to.end(); });
  }
  const auto distance = [&](const Thing* thing) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Thing* target : to) {
      nearest_m = std::min(nearest_m, distanceBetween(*thing, *target));
    }
    return to.empty() && robot_map_ ? (thing->middle_map().head<2>() - *robot_map_).norm() : nearest_m;
  };
  std::vector<std::pair<double, const Thing*>> sorted;
  for (const Thing* thing : resolution.things) {
    sorted.emplace_back(distance(thing), thing);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  resolution.things.clear();
  if (!sorted.empty() && std::isfinite(sorted.front().first)) {
    resolution.things.push_back(sorted.front().second);
  }
  resolution.known = resolution.unknown.empty();
}

Resolution Resolver::resolve(const ThingPhrase& phrase) const {
  if (isFloor(phrase)) {
    Resolution resolution;
    if (!phrase.whole.empty()) {
      resolution = resolve(phrase.whole.front());
    } else if (!phrase.places.empty()) {
      resolution = resolve(phrase.places.front().thing);
    } else {
      for (std::uint32_t i = 0; i < index_.size(); ++i) {
        if (index_.thing(i).kind == ThingKind::kRoom) {
          resolution.things.push_back(&index_.thing(i));
        }
      }
    }
    resolution.floor = true;
    return resolution;
  }
  if (phrase.words.empty() && phrase.whole.empty() && !phrase.ordinal) {
    return contents(phrase);
  }
  Resolution resolution;
  Lookup lookup = lookUp(phrase);
  noteWords(lookup, resolution);
  const std::size_t anywhere = lookup.matches.size();
  if (!phrase.places.empty()) {
    filterByPlaces(phrase, lookup, resolution);
    resolution.elsewhere = anywhere - lookup.matches.size();
  }
  keepOpen(phrase, lookup);
  for (const std::uint32_t number : lookup.best()) {
    resolution.things.push_back(&index_.thing(number));
  }
  if (phrase.nearest) {
    sortByDistance(phrase, resolution);
  }
  for (const ThingPhrase& other : phrase.others) {
    const Resolution more = resolve(other);
    resolution.things.insert(resolution.things.end(), more.things.begin(), more.things.end());
    add(resolution.unknown, more.unknown);
    add(resolution.corrected, more.corrected);
    resolution.known = resolution.unknown.empty();
  }
  return resolution;
}

Resolution Resolver::contents(const ThingPhrase& phrase) const {
  Resolution resolution;
  Lookup all;
  const auto addAll = [&](const Thing& thing) {
    if (thing.kind == ThingKind::kLargeObject || thing.kind == ThingKind::kSmallObject) {
      all.matches.push_back({index_.numberOf(thing), 0});
    }
  };
  const auto addById = [&](const std::string& id) {
    if (const Thing* thing = index_.findById(id)) {
      addAll(*thing);
    }
  };
  const bool narrow = phrase.places.size() == 1 && phrase.places[0].relation <= PlaceRelation::kUnder;
  Resolution places;
  if (narrow) {
    places = resolve(phrase.places[0].thing);
  }
  if (narrow && !places.things.empty() && !onlyRooms(places.things)) {
    for (const Thing* place : places.things) {
      if (place->object != nullptr) {
        std::for_each(place->object->small_objects.begin(), place->object->small_objects.end(),
                      [&](const SmallObject& small) { addById(small.id.value); });
      }
    }
    std::sort(all.matches.begin(), all.matches.end(), [](const Match& a, const Match& b) { return a.thing < b.thing; });
    all.matches.erase(
        std::unique(all.matches.begin(), all.matches.end(), [](const Match& a, const Match& b) { return a.thing == b.thing; }),
        all.matches.end());
  } else {
    for (std::uint32_t i = 0; i < index_.size(); ++i) {
      addAll(index_.thing(i));
    }
  }
  filterByPlaces(phrase, all, resolution);
  keepOpen(phrase, all);
  for (const Match& match : all.matches) {
    resolution.things.push_back(&index_.thing(match.thing));
  }
  if (phrase.nearest) {
    sortByDistance(phrase, resolution);
  }
  return resolution;
}

}  // namespace oikos::semantic
