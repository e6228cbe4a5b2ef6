// SPDX-License-Identifier: Apache-2.0
// What a noun means, by its words, its whole, its side and its ordinal.
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "semantic/query/resolver.h"
#include "semantic/query/sides.h"
#include "semantic/query/whereabouts.h"

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

/// The furniture that a thing is a piece of, or its room.
const void* groupOf(const Thing& thing) {
  return thing.object == nullptr ? static_cast<const void*>(thing.room) : thing.object;
}

/// Where the n-th of so many stands, counted from the top; nothing: there are too few.
std::optional<std::size_t> positionOf(const Ordinal& ordinal, std::size_t count) {
  const auto steps = static_cast<std::size_t>(ordinal.steps);
  const std::size_t at = ordinal.middle ? count / 2 : ordinal.from_bottom ? count - 1 - std::min(steps, count - 1) : steps;
  return at < count && steps < count ? std::optional(at) : std::nullopt;
}

/// The n-th by height among the things of one piece of furniture; of each piece its own.
Things pickByHeight(const Things& things, const Ordinal& ordinal) {
  Things picked;
  std::set<const void*> groups;
  for (const Thing* first : things) {
    if (!groups.insert(groupOf(*first)).second) {
      continue;
    }
    std::vector<std::pair<double, const Thing*>> by_height;
    for (const Thing* thing : things) {
      if (groupOf(*thing) == groupOf(*first)) {
        by_height.emplace_back(-thing->middle_map().z(), thing);
      }
    }
    std::stable_sort(by_height.begin(), by_height.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (const auto position = positionOf(ordinal, by_height.size())) {
      picked.push_back(by_height[*position].second);
    }
  }
  return picked;
}

/// Those that the phrase's side and ordinal mean.
Things pick(const ThingPhrase& phrase, Things things) {
  if (saysSide(phrase)) {
    const bool left = std::find(phrase.words.begin(), phrase.words.end(), "left") != phrase.words.end();
    things = pickBySide(things, left);
  }
  return phrase.ordinal ? pickByHeight(things, *phrase.ordinal) : things;
}

void keep(Lookup& lookup, const HomeIndex& index, const Things& things) {
  std::erase_if(lookup.matches,
                [&](const Match& match) { return std::find(things.begin(), things.end(), &index.thing(match.thing)) == things.end(); });
}

/// "the top kitchen drawer" is one of the "kitchen drawers".
void preferParts(const HomeIndex& index, Lookup& lookup) {
  constexpr int kOwnNoun = 4;  // the worst rank of a thing that the last word names itself
  const auto is_part = [&](const Match& match) { return index.thing(match.thing).kind == ThingKind::kPart && match.rank <= kOwnNoun; };
  if (std::any_of(lookup.matches.begin(), lookup.matches.end(), is_part)) {
    std::erase_if(lookup.matches, [&](const Match& match) { return index.thing(match.thing).kind == ThingKind::kLargeObject; });
  }
}

}  // namespace

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
  Lookup lookup = lookUpNoun(phrase);
  if (!lookup.unknown.empty() || lookup.matches.empty()) {
    return flat.unknown.empty() ? flat : lookup;
  }
  if (phrase.ordinal) {
    preferParts(index_, lookup);
  }
  keep(lookup, index_, pick(phrase, bestOf(lookup)));
  return lookup;
}

/// Without ordinal and side, among the parts of the whole.
Lookup Resolver::lookUpNoun(const ThingPhrase& phrase) const {
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
  return lookup;
}

Things Resolver::bestOf(const Lookup& lookup) const {
  Things things;
  for (const std::uint32_t number : lookup.best()) {
    things.push_back(&index_.thing(number));
  }
  return things;
}

}  // namespace oikos::semantic
