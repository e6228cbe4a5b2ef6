// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/resolver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "semantic/query/found_thing.h"
#include "semantic/query/sides.h"

namespace oikos::semantic {

namespace {

bool isFloor(const ThingPhrase& phrase) {
  return phrase.words.size() == 1 && (phrase.words[0] == "floor" || phrase.words[0] == "ground");
}

void addNew(std::vector<std::string>& list, const std::vector<std::string>& more) {
  for (const std::string& text : more) {
    if (std::find(list.begin(), list.end(), text) == list.end()) {
      list.push_back(text);
    }
  }
}

}  // namespace

void Resolver::noteWords(const Lookup& lookup, Resolution& resolution) {
  addNew(resolution.unknown, lookup.unknown);
  addNew(resolution.corrected, lookup.corrected);
  resolution.known = resolution.unknown.empty();
}

void Resolver::noteWords(const Resolution& more, Resolution& resolution) {
  addNew(resolution.unknown, more.unknown);
  addNew(resolution.corrected, more.corrected);
}

void Resolver::keepOpen(const ThingPhrase& phrase, Lookup& lookup) const {
  if (phrase.open) {
    std::erase_if(lookup.matches, [&](const Match& match) {
      const auto open = isOpen(index_.thing(match.thing));
      return !open || *open != *phrase.open;
    });
  }
}

void Resolver::keepFurniture(const ThingPhrase& phrase, Lookup& lookup) const {
  if (phrase.furniture) {
    std::erase_if(lookup.matches, [&](const Match& match) { return index_.thing(match.thing).kind != ThingKind::kLargeObject; });
  }
}

Things Resolver::takeNearestTo(const ThingPhrase& phrase, Resolution& resolution) const {
  if (phrase.nearest_to.empty()) {
    return {};
  }
  const Resolution target = resolve(phrase.nearest_to.front());
  noteWords(target, resolution);
  std::erase_if(resolution.things,
                [&](const Thing* thing) { return std::find(target.things.begin(), target.things.end(), thing) != target.things.end(); });
  return target.things;
}

void Resolver::sortByDistance(const ThingPhrase& phrase, Resolution& resolution) const {
  const Things to = takeNearestTo(phrase, resolution);
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

/// Of the rooms that the phrase names, or of all.
Resolution Resolver::resolveFloor(const ThingPhrase& phrase) const {
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

Resolution Resolver::resolve(const ThingPhrase& phrase) const {
  if (isFloor(phrase)) {
    return resolveFloor(phrase);
  }
  if (phrase.words.empty() && phrase.whole.empty() && !phrase.ordinal) {
    Resolution resolution = contents(phrase);
    resolveOthers(phrase, resolution);
    return resolution;
  }
  if (const auto whole = withNounOfOthers(phrase)) {
    return resolve(*whole);
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
  keepFurniture(phrase, lookup);
  resolution.things = bestOf(lookup);
  if (phrase.nearest) {
    sortByDistance(phrase, resolution);
  }
  resolveOthers(phrase, resolution);
  return resolution;
}

/// "the red and blue cups": red cups. Nothing: the words are a noun of their own.
std::optional<ThingPhrase> Resolver::withNounOfOthers(const ThingPhrase& phrase) const {
  if (phrase.others.empty() || phrase.words.empty()) {
    return std::nullopt;
  }
  const ThingPhrase* last = &phrase.others.back();
  while (!last->others.empty()) {
    last = &last->others.back();
  }
  if (last->words.size() < 2 || index_.words().isNoun(phrase.words.back()) || !index_.words().isNoun(last->words.back())) {
    return std::nullopt;
  }
  ThingPhrase whole = phrase;
  whole.words.push_back(last->words.back());
  return index_.find(whole.words).matches.empty() ? std::nullopt : std::optional(std::move(whole));
}

/// "the cup and the bowl".
void Resolver::resolveOthers(const ThingPhrase& phrase, Resolution& resolution) const {
  for (const ThingPhrase& other : phrase.others) {
    const Resolution more = resolve(other);
    std::copy_if(more.things.begin(), more.things.end(), std::back_inserter(resolution.things), [&](const Thing* thing) {
      return std::find(resolution.things.begin(), resolution.things.end(), thing) == resolution.things.end();
    });
    resolution.elsewhere += more.elsewhere;
    noteWords(more, resolution);
    resolution.known = resolution.unknown.empty();
  }
}

}  // namespace oikos::semantic
