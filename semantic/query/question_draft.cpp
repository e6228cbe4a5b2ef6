// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_draft.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace oikos::semantic {

namespace {

constexpr auto kAdverbs =
    std::to_array<std::string_view>({"still", "already", "yet", "properly", "fully", "completely", "just", "really", "actually",
                                     "somewhere", "anywhere", "even", "all", "both", "perhaps", "maybe", "currently", "there"});

bool isAdverb(std::string_view word) {
  return std::find(kAdverbs.begin(), kAdverbs.end(), word) != kAdverbs.end();
}

bool isPlacedVerb(std::string_view word) {
  return isOneOf(word, {"lying", "standing", "kept", "stored", "sitting", "hanging", "placed", "located", "resting", "put"});
}

/// "the nearest one to X", "closest to X", "nearest X".
bool takeNearest(WordCursor& words) {
  WordCursor ahead = words;
  ahead.take({"the"});
  if (!ahead.take({"nearest", "closest", "nearer", "closer"})) {
    return false;
  }
  ahead.take({"one", "ones"});
  ahead.take({"to"});
  words = ahead;
  return !words.empty();
}

std::string saidOf(const ThingPhrase& thing, const ThingPhrase& said) {
  std::string text;
  for (const std::string& word : said.words) {
    text += word + " ";
  }
  return text + thing.said;
}

/// What the predicate says is said of the thing.
void merge(ThingPhrase& thing, ThingPhrase said) {
  thing.said = thing.empty() && thing.said.empty() ? said.said : saidOf(thing, said);
  thing.words.insert(thing.words.begin(), said.words.begin(), said.words.end());
  thing.ordinal = said.ordinal ? said.ordinal : thing.ordinal;
  thing.open = said.open ? said.open : thing.open;
  thing.nearest = thing.nearest || said.nearest;
  thing.furniture = thing.furniture || said.furniture;
  std::move(said.nearest_to.begin(), said.nearest_to.end(), std::back_inserter(thing.nearest_to));
  std::move(said.whole.begin(), said.whole.end(), std::back_inserter(thing.whole));
  addPlaces(thing, said.places);
  std::move(said.others.begin(), said.others.end(), std::back_inserter(thing.others));
}

}  // namespace

bool QuestionDraft::finishChange(const std::string& verb) {
  question.state = isOneOf(verb, {"open", "opened"}) ? "open" : isOneOf(verb, {"close", "closed", "shut"}) ? "closed" : "";
  return finish(QuestionKind::kLastChange);
}

std::string stateNamed(const std::string& word) {
  const auto open = opennessOf(word);
  return open ? (*open ? "open" : "closed") : word;
}

bool isStateWord(const std::string& word) {
  return opennessOf(word).has_value() || isOneOf(word, {"on", "off", "running"});
}

std::string oppositeOf(const std::string& state) {
  return state == "open" ? "closed" : state == "closed" ? "open" : state == "on" ? "off" : state == "off" ? "on" : "";
}

bool saysAny(Words thing) {
  return !thing.empty() && isOneOf(thing.front(), {"any", "anything", "something", "one", "some", "a", "an"});
}

bool takeAdverbs(WordCursor& words) {
  bool taken = false;
  while (words.takeIf(isAdverb)) {
    taken = true;
  }
  return taken;
}

bool takeAdverbsBack(WordCursor& words) {
  bool taken = false;
  while (!words.empty() && isAdverb(words.back())) {
    words.dropBack();
    taken = true;
  }
  return taken;
}

std::string takeStateBack(WordCursor& words) {
  if (words.empty() || !isStateWord(words.back())) {
    return {};
  }
  const std::string state = stateNamed(words.back());
  words.dropBack();
  bool negated = false;
  while (takeAdverbsBack(words) || words.takeBack({"turned", "switched", "wide", "left", "standing", "been", "be", "pulled", "kept"}) ||
         (!negated && words.takeBack({"not"}) && (negated = true))) {
  }
  return negated ? oppositeOf(state) : state;
}

PlacePhrase having(ThingPhrase whole) {
  PlacePhrase on{PlaceRelation::kOn, whole, false, {}};
  return {PlaceRelation::kIn, std::move(whole), false, {std::move(on)}};
}

void addPlaces(ThingPhrase& thing, const std::vector<PlacePhrase>& places) {
  thing.places.insert(thing.places.end(), places.begin(), places.end());
  for (ThingPhrase& other : thing.others) {
    addPlaces(other, places);
  }
}

bool QuestionDraft::finish(QuestionKind kind) {
  question.kind = kind;
  while (words.takeBack({"there", "anywhere", "somewhere"}) ||
         (words.rest().size() > 1 && isBe(words.back()) && (words.dropBack(), true))) {
  }
  if (words.empty()) {
    return false;
  }
  question.thing = readThingPhrase(words.rest());
  return true;
}

bool QuestionDraft::finishPredicate(ThingPhrase thing, WordCursor predicate) {
  (void)takeAdverbs(predicate);
  while (predicate.rest().size() > 1 && isBe(predicate.back())) {
    predicate.dropBack();
  }
  (void)takeAdverbsBack(predicate);
  if (predicate.empty()) {
    return false;
  }
  WordCursor before_state = predicate;
  question.state = takeStateBack(before_state);
  if (!question.state.empty() && before_state.empty()) {
    question.kind = QuestionKind::kWhichState;
    question.thing = std::move(thing);
    return true;
  }
  question.state.clear();
  question.kind = QuestionKind::kWhere;
  if (!thing.empty() && takeNearest(predicate)) {
    thing.nearest = true;
    thing.nearest_to.push_back(readThingPhrase(predicate.rest()));
    question.thing = std::move(thing);
    return true;
  }
  const bool not_there = predicate.startsWith({"not"}) && findRelationWords(predicate.rest().subspan(1));
  if (not_there || isPlacedVerb(predicate.front()) || findRelationWords(predicate.rest())) {
    question.kind = QuestionKind::kContents;
  }
  edited.assign(predicate.rest().begin(), predicate.rest().end());
  edited.insert(edited.begin(), "that");
  merge(thing, readThingPhrase(edited));
  question.thing = std::move(thing);
  return true;
}

}  // namespace oikos::semantic
