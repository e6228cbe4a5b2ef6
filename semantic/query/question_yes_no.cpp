// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"

#include <algorithm>
#include <string>

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

/// After "did I": "leave X on", "close X", "turn off X".
bool readLeft(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  draft.question.kind = QuestionKind::kIsState;
  if (words.take({"close", "shut"})) {
    draft.question.state = "closed";
  } else if (words.take({"open"})) {
    draft.question.state = "open";
  } else if (words.take({"turn", "switch", "turned", "switched"})) {
    const bool off = words.takeBack({"off"}) || words.take({"off"});
    draft.question.state = off ? "off" : "on";
    words.takeBack({"on"}) || words.take({"on"});
  } else if (words.take({"leave", "left"}) && words.rest().size() > 1 && isStateWord(words.back())) {
    draft.question.state = stateNamed(words.back());
    words.dropBack();
  } else {
    return !words.empty() && draft.finish(QuestionKind::kIsThere);
  }
  return draft.finish(QuestionKind::kIsState);
}

/// After "is".
bool readIs(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"there"})) {
    return draft.finish(QuestionKind::kIsThere);
  }
  while (words.takeBack({"still", "already", "yet", "properly", "fully"})) {
  }
  const Words rest = words.rest();
  if (rest.size() > 1 && isStateWord(rest.back())) {
    draft.question.state = stateNamed(rest.back());
    words.dropBack();
    words.takeBack({"turned", "switched", "still", "wide", "already", "left", "standing"});
    return draft.finish(QuestionKind::kIsState);
  }
  const std::size_t set = words.find({"set", "turned", "switched"});
  if (set > 0 && set + 2 < rest.size() && isOneOf(rest[set + 1], {"to", "at", "on"})) {
    for (const std::string& word : rest.subspan(set + 2)) {
      draft.question.state += (draft.question.state.empty() ? "" : " ") + word;
    }
    words = WordCursor(rest.first(set));
    return draft.finish(QuestionKind::kIsState);
  }
  return draft.finish(QuestionKind::kIsThere);
}

/// "is anything open".
bool askWhetherAny(QuestionDraft& draft) {
  draft.question.kind = QuestionKind::kIsThere;
  draft.question.thing.open = draft.question.state == "open";
  return draft.question.state == "open" || draft.question.state == "closed";
}

/// "have you", "did anyone".
bool takeSomeoneActing(WordCursor& words) {
  if (words.startsWith({"have", "you"}) || words.startsWith({"did", "you"}) || words.startsWith({"can", "you"}) ||
      words.startsWith({"do", "you"}) || words.startsWith({"has", "anyone"}) || words.startsWith({"did", "anyone"}) ||
      words.startsWith({"has", "anybody"}) || words.startsWith({"has", "someone"}) || words.startsWith({"did", "someone"})) {
    words.drop(2);
    return true;
  }
  return false;
}

/// After "have you": "moved X", "seen X".
bool readSomeoneActing(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::string verb = words.empty() ? "" : words.front();
  if (words.take({"move", "moved", "change", "changed", "touch", "touched", "open", "opened", "close", "closed", "use", "used"})) {
    return draft.finishChange(verb);
  }
  words.take({"ever", "last"});
  return words.takeIf(isSeeing) && draft.finish(QuestionKind::kWhere);
}

/// After "has" or "does": "X moved", "X contain Y".
bool readDoes(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::string last = words.empty() ? "" : words.back();
  if (words.takeBack({"move", "moved", "change", "changed", "opened", "closed", "touched", "used"})) {
    words.takeBack({"been"});
    return draft.finishChange(last);
  }
  const std::size_t verb = words.find({"contain", "have", "hold"});
  if (verb == 0 || verb + 1 >= words.rest().size()) {
    return false;
  }
  draft.question.kind = QuestionKind::kIsThere;
  draft.question.thing = readThingPhrase(words.rest().subspan(verb + 1));
  draft.question.thing.places.push_back({PlaceRelation::kIn, readThingPhrase(words.rest().first(verb))});
  return true;
}

}  // namespace

bool readYesNo(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (!words.empty() && isBe(words.front())) {
    draft.question.all = isOneOf(words.front(), {"are", "were"});
    words.drop();
    draft.question.any = !words.empty() && isOneOf(words.front(), {"any", "anything", "something", "one", "some"});
    return readIs(draft) && (!draft.question.thing.words.empty() || draft.question.kind != QuestionKind::kIsState || askWhetherAny(draft));
  }
  if (words.takeAll({"do", "we"}) || words.takeAll({"have", "we"}) || words.takeAll({"do", "i"}) || words.takeAll({"have", "i"})) {
    words.take({"have", "got", "own"});
    words.take({"got"});
    return draft.finish(QuestionKind::kIsThere);
  }
  if (takeSomeoneActing(words)) {
    return readSomeoneActing(draft);
  }
  if (words.takeAll({"did", "i"}) || words.takeAll({"did", "we"}) || words.takeAll({"have", "i"})) {
    return readLeft(draft);
  }
  return words.take({"does", "did", "has", "have"}) && readDoes(draft);
}

bool readSentence(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::size_t be = words.find({"is", "are"});
  if (be > 0 && be + 1 < words.rest().size()) {
    draft.is_statement = true;
    draft.edited.assign(words.rest().begin(), words.rest().end());
    draft.edited.erase(draft.edited.begin() + static_cast<std::ptrdiff_t>(be));
    if (draft.edited.size() > 1 && isStateWord(draft.edited.back())) {
      words = WordCursor(draft.edited);
      return readIs(draft);
    }
    if (findRelationWords(Words(draft.edited).subspan(be))) {
      words = WordCursor(draft.edited);
      return draft.finish(QuestionKind::kIsThere);
    }
    draft.is_statement = false;
    return false;
  }
  const std::size_t nearest = words.find({"nearest", "closest"});
  return nearest < std::min<std::size_t>(words.rest().size(), 2) && draft.finish(QuestionKind::kWhere);
}

}  // namespace oikos::semantic
