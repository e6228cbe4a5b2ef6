// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "semantic/query/question_kinds.h"
#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

/// finish() of a question whether the thing is in `state`.
bool finishState(QuestionDraft& draft, std::string state) {
  draft.question.state = std::move(state);
  draft.question.any = draft.question.any || saysAny(draft.words.rest());
  if (!draft.finish(QuestionKind::kIsState)) {
    return false;
  }
  const ThingPhrase& thing = draft.question.thing;
  draft.question.all = draft.question.all || thing.every;
  return !thing.empty() || thing.every || draft.question.any;  // "is it open": what?
}

/// After "did I": "leave X on", "close X", "turn off X"; after "has anyone" the same.
bool readLeft(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"close", "shut"})) {
    return finishState(draft, "closed");
  }
  if (words.take({"open"})) {
    return finishState(draft, "open");
  }
  if (words.take({"turn", "switch", "turned", "switched"})) {
    const bool off = words.takeBack({"off"}) || words.take({"off"});
    words.takeBack({"on"}) || words.take({"on"});
    return finishState(draft, off ? "off" : "on");
  }
  WordCursor ahead = words;
  if (!ahead.take({"leave", "left"})) {
    return false;
  }
  std::string state = takeStateBack(ahead);
  if (state.empty() && !ahead.empty() && isStateWord(ahead.front())) {  // "left open the door"
    state = stateNamed(ahead.front());
    ahead.drop();
  }
  words = state.empty() ? words : ahead;
  return !state.empty() && finishState(draft, state);
}

/// "open or closed": which of both, so no yes or no.
bool readEitherState(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  const std::string second = takeStateBack(ahead);
  if (second.empty() || !ahead.takeBack({"or"})) {
    return false;
  }
  const std::string first = takeStateBack(ahead);
  if (first.empty() || ahead.empty()) {
    return false;
  }
  draft.words = ahead;
  return draft.finish(first == "open" || first == "closed" ? QuestionKind::kHowFar : QuestionKind::kSetting);
}

/// "there an open door in the hall" asks for its state, as "an open door" does.
bool finishIsThere(QuestionDraft& draft) {
  draft.question.all = false;
  draft.words.take({"no"});  // "are there no cups" asks whether there are
  if (!draft.finish(QuestionKind::kIsThere)) {
    return false;
  }
  ThingPhrase& thing = draft.question.thing;
  if (thing.counted) {  // "are there five cups": exactly, or at least?
    return false;
  }
  if (thing.open && thing.others.empty()) {
    draft.question.kind = QuestionKind::kIsState;
    draft.question.state = *thing.open ? "open" : "closed";
    draft.question.any = true;
    thing.open.reset();
  }
  return true;
}

/// "the cups in the kitchen": all of them? "every", "and" before a further place ask more than whether something is there.
bool finishIsAt(QuestionDraft& draft) {
  const bool definite =
      !draft.words.empty() && isOneOf(draft.words.front(), {"the", "my", "our", "your", "his", "her", "their", "these", "those"});
  if (!draft.finish(QuestionKind::kIsThere)) {
    return false;
  }
  const ThingPhrase& thing = draft.question.thing;
  draft.question.all = thing.every || (definite && draft.question.all);
  return std::none_of(thing.places.begin(), thing.places.end(), [](const PlacePhrase& place) {
    const auto& others = place.thing.others;
    return place.thing.every || std::any_of(others.begin(), others.end(), [](const ThingPhrase& other) { return !other.places.empty(); });
  });
}

/// After "is".
bool readIs(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"there"})) {
    return finishIsThere(draft);
  }
  if (readEitherState(draft)) {
    return true;
  }
  (void)takeAdverbsBack(words);
  WordCursor before_state = words;
  if (std::string state = takeStateBack(before_state); !state.empty() && !before_state.empty()) {
    words = before_state;
    return finishState(draft, std::move(state));
  }
  const Words rest = words.rest();
  const std::size_t set = words.find({"set", "turned", "switched"});
  if (set > 0 && set + 2 < rest.size() && isOneOf(rest[set + 1], {"to", "at", "on"})) {
    for (const std::string& word : rest.subspan(set + 2)) {
      draft.question.state += (draft.question.state.empty() ? "" : " ") + word;
    }
    words = WordCursor(rest.first(set));
    return draft.finish(QuestionKind::kIsState);
  }
  return finishIsAt(draft);
}

/// "anything changed", "something been moved": whether, and what.
bool readAnyChange(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (!ahead.take({"anything", "something", "things", "everything"})) {
    return false;
  }
  (void)takeAdverbs(ahead);
  ahead.take({"been"});
  const std::size_t verb = ahead.find({"change", "changed", "move", "moved", "happened", "happen", "new", "different"});
  if (ahead.empty() || verb != 0) {
    return false;
  }
  ahead.drop();
  draft.words = ahead;
  draft.question.kind = QuestionKind::kChanges;
  draft.question.any = true;
  draft.question.thing = readThingPhrase(ahead.rest());
  return true;
}

/// After "have you": "moved X", "seen X", "left X open", "got X".
bool readActing(QuestionDraft& draft, bool of_speaker) {
  WordCursor& words = draft.words;
  (void)takeAdverbs(words);
  words.take({"ever", "last"});
  const std::string verb = words.empty() ? "" : words.front();
  const bool changes = isOneOf(verb, {"move", "moved", "change", "changed", "touch", "touched", "opened", "closed", "use", "used"}) ||
                       (!of_speaker && isOneOf(verb, {"open", "close"}));
  if (changes) {
    words.drop();
    return draft.finishChange(verb);
  }
  if (words.take({"have", "got", "own", "keep"})) {
    words.take({"got"});
    return draft.finish(QuestionKind::kIsThere);
  }
  if (words.takeIf(isSeeing)) {
    return draft.finish(QuestionKind::kWhere);
  }
  return readLeft(draft) || (of_speaker && words.take({"put", "place", "placed", "leave", "left", "store", "stored"}) && finishIsAt(draft));
}

/// "have you", "did anyone", "do we". The speaker's own "have" and "do" say what there is: "have we milk".
bool takeActor(WordCursor& words, bool& of_speaker) {
  WordCursor ahead = words;
  if ((words.startsWith({"can"}) || words.startsWith({"could"})) && words.rest().size() > 2 && !isSeeing(words.rest()[2])) {
    return false;
  }
  if (!ahead.take({"have", "has", "did", "do", "does", "can", "could"}) || ahead.empty() ||
      !isOneOf(ahead.front(), {"i", "we", "you", "anyone", "anybody", "someone", "somebody"})) {
    return false;
  }
  of_speaker = isOneOf(ahead.front(), {"i", "we"});
  ahead.drop();
  words = ahead;
  return true;
}

/// After "has" or "does": "X moved", "X been left open", "X contain Y", "X got Y".
bool readDoes(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (readAnyChange(draft)) {
    return true;
  }
  const std::string last = words.empty() ? "" : words.back();
  if (words.takeBack({"move", "moved", "change", "changed", "opened", "closed", "touched", "used"})) {
    words.takeBack({"been"});
    return draft.finishChange(last);
  }
  WordCursor before_state = words;
  if (std::string state = takeStateBack(before_state); !state.empty() && !before_state.empty()) {  // "the fridge been left open"
    words = before_state;
    return finishState(draft, std::move(state));
  }
  if (const std::size_t been = words.find({"been"}); been > 0 && been + 2 < words.rest().size() &&
                                                     isOneOf(words.rest()[been + 1], {"left", "put", "placed", "laid", "dropped"}) &&
                                                     findRelationWords(words.rest().subspan(been + 2))) {
    draft.edited.assign(words.rest().begin(), words.rest().end());
    draft.edited.erase(draft.edited.begin() + static_cast<std::ptrdiff_t>(been),
                       draft.edited.begin() + static_cast<std::ptrdiff_t>(been + 2));
    words = WordCursor(draft.edited);
    return finishIsAt(draft);
  }
  const std::size_t verb = words.find({"contain", "have", "hold", "got"});
  if (verb == 0 || verb + 1 >= words.rest().size()) {
    return false;
  }
  draft.question.kind = QuestionKind::kIsThere;
  draft.question.thing = readThingPhrase(words.rest().subspan(verb + 1));
  const ThingPhrase whole = readThingPhrase(words.rest().first(verb));
  addPlaces(draft.question.thing, {having(whole)});
  return !whole.every;
}

}  // namespace

bool readYesNo(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (!words.empty() && isBe(words.front())) {
    draft.question.all = isOneOf(words.front(), {"are", "were"});
    words.drop();
    return readIs(draft);
  }
  if (!words.empty() && isOneOf(words.front(), {"any", "anything", "something"})) {
    return readAnyChange(draft) || finishIsThere(draft);
  }
  if (words.startsWith({"got", "any"}) || words.startsWith({"got", "some"})) {
    words.drop();
    return finishIsThere(draft);
  }
  bool of_speaker = false;
  if (takeActor(words, of_speaker)) {
    return readActing(draft, of_speaker);
  }
  return words.take({"does", "did", "has", "have"}) && readDoes(draft);
}

bool readSentence(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::size_t be = words.find({"is", "are", "was", "were"});
  if (be > 0 && be + 1 < words.rest().size()) {
    draft.is_statement = true;
    draft.question.all = isOneOf(words.rest()[be], {"are", "were"});
    draft.edited.assign(words.rest().begin(), words.rest().end());
    draft.edited.erase(draft.edited.begin() + static_cast<std::ptrdiff_t>(be));
    WordCursor predicate{Words(draft.edited).subspan(be)};
    const bool there = be == 1 && words.front() == "there";
    (void)takeAdverbs(predicate);
    predicate.take({"not"});
    const bool is_state =
        !predicate.empty() && (isStateWord(predicate.back()) || isOneOf(predicate.front(), {"left", "turned", "switched"}));
    if (there || is_state || findRelationWords(predicate.rest())) {
      words = WordCursor(draft.edited);
      return readIs(draft);
    }
    draft.is_statement = false;
    return false;
  }
  if (readEitherState(draft)) {  // "oven on or off?"
    return true;
  }
  WordCursor before_state = words;
  std::string state = takeStateBack(before_state);
  if (!state.empty() && !before_state.empty() && !isStateWord(before_state.front())) {  // "oven off?"
    words = before_state;
    return finishState(draft, std::move(state));
  }
  const std::size_t nearest = words.find({"nearest", "closest"});
  return nearest < std::min<std::size_t>(words.rest().size(), 2) && draft.finish(QuestionKind::kWhere);
}

}  // namespace oikos::semantic
