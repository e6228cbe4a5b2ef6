// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

/// "has changed", "things have moved", "is new", "happened".
bool readChanges(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  const std::size_t verb = ahead.find({"changed", "change", "moved", "move", "happened", "happen", "new", "different"});
  if (verb == ahead.rest().size()) {
    return false;
  }
  const Words noun = ahead.rest().first(verb);
  const bool only_helpers = std::all_of(noun.begin(), noun.end(), [](const std::string& word) {
    return isBe(word) || isOneOf(word, {"has", "have", "did", "been", "things", "objects", "all", "everything", "anything", "of", "the"});
  });
  ahead.drop(verb + 1);
  const bool at_end = ahead.empty() || findRelationWords(ahead.rest());
  if (!at_end || (!only_helpers && !isOneOf(draft.words.rest()[verb], {"changed", "moved"}))) {
    return false;
  }
  draft.question.kind = QuestionKind::kChanges;
  draft.edited.clear();
  std::copy_if(noun.begin(), noun.end(), std::back_inserter(draft.edited), [](const std::string& word) {
    return !isBe(word) && !isOneOf(word, {"has", "have", "did", "been"});
  });
  draft.edited.insert(draft.edited.end(), ahead.rest().begin(), ahead.rest().end());
  draft.question.thing = readThingPhrase(draft.edited);
  return true;
}

/// "can X be used for", "is X good for", "can I sit on".
bool readUses(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (!words.empty() && words.back() == "for" && words.rest().size() > 2) {
    words.dropBack();
    words.takeBack({"used", "good", "useful", "made"});
    words.takeBack({"be"});
    words.takeModal() || words.takeBe();
    words.takeSpeaker() && words.take({"use"});
    return draft.finish(QuestionKind::kUse);
  }
  WordCursor ahead = words;
  while (ahead.take({"things", "objects", "furniture", "thing", "object"})) {
  }
  if (!ahead.take({"can", "could"}) || !ahead.takeSpeaker() || ahead.empty()) {
    return false;
  }
  if (ahead.takeAll({"do", "with"})) {
    words = ahead;
    return draft.finish(QuestionKind::kUse);
  }
  if (isSeeing(ahead.front())) {
    return false;
  }
  draft.question.kind = QuestionKind::kWhatFor;
  draft.question.use.assign(ahead.rest().begin(), ahead.rest().end());
  return true;
}

/// "is X set to", "is X at", "temperature is X set to", "is the temperature of X".
bool readSettings(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.rest().size() < 3) {
    return false;
  }
  const Words rest = words.rest();
  const bool set_to = isOneOf(rest.back(), {"to", "at", "on"}) && isOneOf(rest[rest.size() - 2], {"set", "turned", "switched"});
  const bool is_at = isBe(rest.front()) && rest.back() == "at";
  const std::size_t be = words.find({"is", "are", "was", "were"});
  const bool named = be == 1 && isOneOf(rest.front(), {"program", "programme", "temperature", "setting", "level", "mode"});
  if (set_to || is_at || (named && isOneOf(rest.back(), {"on", "at", "in", "to", "set"}))) {
    words.drop(std::min(be + 1, rest.size()));
    while (words.takeBack({"to", "at", "set", "turned", "switched", "on", "in"})) {
    }
    return draft.finish(QuestionKind::kSetting);
  }
  if (isBe(rest.front()) && rest[1] == "the" && isOneOf(rest[2], {"setting", "temperature", "program", "state", "level", "position"}) &&
      rest.size() > 4 && isOneOf(rest[3], {"of", "in"})) {
    words.drop(4);
    return draft.finish(QuestionKind::kSetting);
  }
  return false;
}

/// "colour is X", "is the colour of X".
bool readProperty(QuestionDraft& draft) {
  const auto property = [](const std::string& word) -> std::string {
    return isOneOf(word, {"colour", "color", "colors", "colours"})   ? "color"
           : isOneOf(word, {"content", "contents"})                  ? "content"
           : isOneOf(word, {"type", "kind", "size", "owner"})        ? word
           : isOneOf(word, {"material", "brand", "weight", "shape"}) ? word
                                                                     : "";
  };
  WordCursor ahead = draft.words;
  if (ahead.rest().size() > 2 && !property(ahead.front()).empty() && isBe(ahead.rest()[1])) {
    draft.question.property = property(ahead.front());
    draft.words.drop(2);
    return draft.finish(QuestionKind::kProperty);
  }
  if (ahead.takeBe() && ahead.take({"the"}) && ahead.rest().size() > 2 && !property(ahead.front()).empty() && ahead.rest()[1] == "of") {
    draft.question.property = property(ahead.front());
    draft.words.drop(4);
    return draft.finish(QuestionKind::kProperty);
  }
  return false;
}

bool finishContents(QuestionDraft& draft, const ThingPhrase& thing, const std::vector<PlacePhrase>& places) {
  draft.question.kind = QuestionKind::kContents;
  draft.question.thing = thing;
  draft.question.thing.places.insert(draft.question.thing.places.end(), places.begin(), places.end());
  return true;
}

/// "is", "do we have", "can you see", with "there"; false: nothing comes after it.
bool skipHelpers(WordCursor& words) {
  if (words.takeModal() || words.take({"have"})) {
    words.takeSpeaker();
    words.take({"have", "see", "got", "find", "keep", "own"});
    words.take({"got"});
  } else {
    words.drop();
  }
  words.take({"there"});
  return !words.empty();
}

/// "is on Y", "X are on Y", "X are open", "cup is nearest to Y", "room is X in", "is X".
bool readContents(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::size_t verb =
      words.find({"is", "are", "was", "were", "lies", "stands", "lie", "stand", "sits", "sit", "do", "did", "have", "can"});
  if (verb == words.rest().size()) {
    return false;
  }
  const Words noun = words.rest().first(verb);
  words.drop(verb);
  if (!skipHelpers(words)) {
    return false;
  }
  const bool ends_with_place = words.rest().size() > 1 && isOneOf(words.back(), {"in", "on", "under", "at", "inside"});
  if (ends_with_place) {  // "which room is the cup in"
    words.dropBack();
    return draft.finish(QuestionKind::kWhere);
  }
  if (words.rest().size() == 1 && isStateWord(words.front())) {
    draft.question.kind = QuestionKind::kWhichState;
    draft.question.state = stateNamed(words.front());
    draft.question.thing = readThingPhrase(noun);
    return true;
  }
  const bool says_place =
      findRelationWords(words.rest()).has_value() || isOneOf(words.front(), {"lying", "standing", "kept", "stored", "sitting"});
  draft.edited.assign(noun.begin(), noun.end());
  draft.edited.insert(draft.edited.end(), words.rest().begin(), words.rest().end());
  words = WordCursor(draft.edited);
  return draft.finish(says_place ? QuestionKind::kContents : QuestionKind::kWhere);
}

}  // namespace

bool readWhat(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  words.take({"else", "exactly"});
  if (readChanges(draft) || readUses(draft) || readSettings(draft)) {
    return true;
  }
  if (words.takeAll({"is", "the", "history", "of"}) || words.takeAll({"history", "does"})) {
    words.takeBack({"have"});
    return draft.finish(QuestionKind::kHistory);
  }
  if (readProperty(draft)) {
    return true;
  }
  if (const bool does = words.startsWith({"does"}) || words.startsWith({"did"});
      does && (words.rest().back() == "contain" || words.rest().back() == "hold" || words.rest().back() == "have")) {
    words.drop();
    words.dropBack();
    return finishContents(draft, {}, {{PlaceRelation::kIn, readThingPhrase(words.rest())}});
  }
  return readContents(draft);
}

}  // namespace oikos::semantic
