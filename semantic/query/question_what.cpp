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

bool isSettingNoun(std::string_view word) {
  return isOneOf(word, {"program", "programme", "temperature", "setting", "level", "mode", "number", "heat", "stage", "degree", "mark",
                        "state", "position", "speed"});
}

bool isSetVerb(std::string_view word) {
  return isOneOf(word, {"set", "turned", "switched", "selected", "chosen", "running", "active", "put", "dialled"});
}

/// "is the setting of X".
bool readSettingOf(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (!ahead.takeBe() || !ahead.take({"the"}) || !ahead.takeIf(isSettingNoun) || !ahead.take({"of", "in", "on"}) || ahead.empty()) {
    return false;
  }
  draft.words = ahead;
  return draft.finish(QuestionKind::kSetting);
}

/// "temperature is X set to", "programme is selected on X", "number is X on".
bool readNamedSetting(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (!ahead.takeIf(isSettingNoun) || !(ahead.takeBe() || ahead.take({"does", "has", "did"}))) {
    return false;
  }
  const bool verb_first = ahead.takeIf(isSetVerb) && ahead.take({"on", "for", "at", "in"});
  bool names_setting = verb_first;
  while (ahead.rest().size() > 1 &&
         (ahead.takeBack({"to", "at", "on", "in", "have"}) || (isSetVerb(ahead.back()) && (ahead.dropBack(), true)))) {
    names_setting = true;
  }
  if (!names_setting || ahead.empty()) {
    return false;
  }
  draft.words = ahead;
  return draft.finish(QuestionKind::kSetting);
}

/// "is X set to", "is X at", "is X on": the last may ask for a place as well.
bool readSettings(QuestionDraft& draft) {
  if (readSettingOf(draft) || readNamedSetting(draft)) {
    return true;
  }
  WordCursor ahead = draft.words;
  if (ahead.rest().size() < 3 || !ahead.takeBe()) {
    return false;
  }
  const bool is_at = ahead.takeBack({"at"});
  const bool is_to = !is_at && ahead.takeBack({"to"});
  const bool is_on = !is_at && !is_to && ahead.takeBack({"on"});
  const bool is_set = ahead.rest().size() > 1 && isSetVerb(ahead.back()) && (ahead.dropBack(), true);
  if (!is_at && !is_on && !(is_to && is_set)) {
    return false;
  }
  draft.words = ahead;
  if (!is_set && is_on) {
    (void)draft.finish(QuestionKind::kWhere);
    draft.otherwise = draft.question;
  }
  return draft.finish(QuestionKind::kSetting);
}

/// "colour is X", "is the colour of X".
bool readProperty(QuestionDraft& draft) {
  const auto property = [](const std::string& word) -> std::string {
    return isOneOf(word, {"colour", "color", "colors", "colours"})   ? "color"
           : word == "content"                                       ? "content"
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

/// "the contents of X": of what it has as a content, else of what is in it.
bool readContentsOf(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  ahead.takeBe();
  ahead.take({"the"});
  if (!ahead.takeAll({"contents", "of"}) || ahead.empty()) {
    return false;
  }
  draft.question.kind = QuestionKind::kContents;
  draft.question.thing = ThingPhrase{};
  addPlaces(draft.question.thing, {having(readThingPhrase(ahead.rest()))});
  draft.otherwise = draft.question;
  draft.words = ahead;
  draft.question.property = "content";
  return draft.finish(QuestionKind::kProperty);
}

/// "X does Y hold", "X has Y got", "do we have": what Y has. `noun`: X.
bool readHeld(QuestionDraft& draft, Words noun) {
  WordCursor ahead = draft.words;
  const bool has = ahead.take({"has", "have"});
  if ((!has && !ahead.take({"does", "do", "did"})) || ahead.empty() || isSpeaker(ahead.front()) || ahead.front() == "you") {
    return false;
  }
  ahead.takeAllBack({"in", "it"}) || ahead.takeAllBack({"on", "it"});
  if (!ahead.takeBack({"contain", "hold", "have", "got", "carry", "store"}) || ahead.empty()) {
    return false;
  }
  draft.question.kind = QuestionKind::kContents;
  draft.question.thing = readThingPhrase(noun);
  addPlaces(draft.question.thing, {having(readThingPhrase(ahead.rest()))});
  return true;
}

/// "is", "do we have", "can you see", with "there"; false: nothing comes after it.
bool skipHelpers(WordCursor& words) {
  if (words.takeModal() || words.take({"have"})) {
    words.takeSpeaker();
    words.take({"have", "see", "got", "find", "keep", "own", "left", "put"});
    words.take({"got"});
    words.take({"been"});
  } else {
    words.drop();
  }
  words.take({"there"});
  return !words.empty();
}

/// "is on Y", "X are on Y", "X are open", "cup is nearest to Y", "room is X in", "is X".
bool readPredicate(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  words.take({"of"});
  const std::size_t verb =
      words.find({"is", "are",  "was", "were", "lies", "stands", "lie",   "stand",    "sits",  "sit",  "hangs", "hang",
                  "do", "does", "did", "have", "has",  "can",    "holds", "contains", "lives", "live", "stays", "hides"});
  if (verb == words.rest().size()) {
    return false;
  }
  const Words noun = words.rest().first(verb);
  words.drop(verb);
  if (readHeld(draft, noun)) {
    return true;
  }
  if (verb > 0 && words.take({"has", "holds", "contains"})) {  // "which drawer holds the spoons"
    words.take({"got"});
    return draft.finish(QuestionKind::kWhere);
  }
  if (!skipHelpers(words)) {  // "what rooms do we have"
    draft.question.kind = QuestionKind::kWhere;
    draft.question.thing = readThingPhrase(noun);
    return true;
  }
  const bool ends_with_place = words.rest().size() > 1 && words.takeBack({"in", "on", "under", "at", "inside"});
  if (ends_with_place) {  // "which room is the cup in"
    return draft.finish(QuestionKind::kWhere);
  }
  return draft.finishPredicate(readThingPhrase(noun), words);
}

/// "is the location of X", "spot do I drive to": what has a name of its own.
bool readNamedThing(QuestionDraft& draft) {
  const WordCursor before = draft.words;
  draft.words.takeBe();
  if (readNamed(draft)) {
    return true;
  }
  draft.words = before;
  return false;
}

/// "do I have to do to", "must I do to".
bool takeWhatToDo(WordCursor& words) {
  WordCursor ahead = words;
  if (!ahead.takeModal() || !ahead.takeSpeaker()) {
    return false;
  }
  ahead.takeAll({"have", "to"}) || ahead.takeAll({"need", "to"});
  const bool taken = ahead.takeAll({"do", "to"}) || ahead.takeAll({"do", "for"});
  words = taken ? ahead : words;
  return taken;
}

/// Anything: "things", "everything that".
bool namesAll(Words noun) {
  return std::all_of(noun.begin(), noun.end(), [](const std::string& word) {
    return isOneOf(word, {"things", "objects", "items", "everything", "all", "that", "which", "the", "of"});
  });
}

}  // namespace

bool readBelongs(QuestionDraft& draft) {
  const std::size_t verb = draft.words.find({"belong", "belongs"});
  const Words noun = draft.words.rest().first(verb);
  WordCursor ahead = draft.words;
  ahead.drop(std::min(verb + 1, ahead.rest().size()));
  if (!ahead.take({"to"}) || ahead.empty()) {
    return false;
  }
  draft.question.kind = QuestionKind::kWhere;
  draft.question.thing = readThingPhrase(namesAll(noun) ? Words() : noun);
  draft.question.thing.whole.push_back(readThingPhrase(ahead.rest()));
  return true;
}

bool readWhat(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  words.take({"else", "exactly", "all"});
  if (takeWhatToDo(words)) {
    return readHowTo(draft);
  }
  if (readNamedThing(draft) || readContentsOf(draft) || readChanges(draft) || readUses(draft) || readSettings(draft)) {
    return true;
  }
  if (words.takeAll({"is", "the", "history", "of"}) || words.takeAll({"history", "does"})) {
    words.takeBack({"have"});
    return draft.finish(QuestionKind::kHistory);
  }
  return readProperty(draft) || readBelongs(draft) || readPredicate(draft);
}

}  // namespace oikos::semantic
