// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"
#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

/// Somewhere among the words.
bool takeWord(QuestionDraft& draft, WordList list) {
  WordCursor& words = draft.words;
  if (const std::size_t position = words.find(list); position < words.rest().size()) {
    draft.edited.assign(words.rest().begin(), words.rest().end());
    draft.edited.erase(draft.edited.begin() + static_cast<std::ptrdiff_t>(position));
    words = WordCursor(draft.edited);
    return true;
  }
  return false;
}

/// "to", "in order to", "so that the camera can", "if I want to".
void takePurpose(WordCursor& words) {
  words.takeAll({"in", "order"}) || words.takeAll({"for"});
  if (words.takeAll({"so", "that"}) || words.takeAll({"such", "that"}) || words.takeAll({"so", "as"}) || words.take({"so", "if", "when"})) {
    words.take({"the", "my", "your"});
    words.take({"camera", "robot", "arm", "i", "you", "we", "it", "one"});
    words.take({"can", "could", "may", "want", "wants", "need", "needs", "have"}) || words.takeAll({"would", "like"}) ||
        words.takeAll({"am", "able"}) || words.takeAll({"is", "able"});
  }
  words.take({"to"});
  words.takeAll({"be", "able", "to"});
}

/// After "where do I", "where did you": "stand to reach X", "position the base so the camera sees X".
bool readStandPlace(QuestionDraft& draft) {
  WordCursor words = draft.words;
  if (words.take({"position", "place", "put", "park", "move", "drive"})) {
    words.take({"the", "my", "your"});
    words.take({"base", "robot", "camera", "myself", "yourself", "itself"});
  } else if (!words.takeAll({"be", "standing"}) && !words.take({"stand", "go", "be", "stay", "wait"})) {
    return false;
  }
  const std::size_t before = words.rest().size();
  takePurpose(words);
  if (words.rest().size() == before) {
    return false;
  }
  draft.words = words;
  return readStandGoal(draft);
}

/// After "where do I", "where did you".
bool readWhereSpeaker(QuestionDraft& draft, bool of_the_past) {
  WordCursor& words = draft.words;
  words.takeAll({"have", "to"}) || words.takeAll({"need", "to"});
  words.take({"last", "usually", "normally"});
  if (readStandPlace(draft)) {
    return true;
  }
  if (words.take({"put", "store", "return"})) {
    words.takeBack({"back", "away"});
    return draft.finish(of_the_past ? QuestionKind::kWhere : QuestionKind::kUsualPlace);
  }
  words.takeIf(isSeeing) || words.takeAll({"look", "for"}) ||
      words.take({"leave", "left", "put", "get", "have", "keep", "lose", "lay", "drop"});
  words.takeBack({"last"});
  return draft.finish(QuestionKind::kWhere);
}

/// What may follow the thing: "has got to", "might be", "has been put".
void takeWhereTail(WordCursor& words) {
  const auto left = [&] {  // "have been left", but no "on the left"
    const Words rest = words.rest();
    return rest.size() > 2 && rest.back() == "left" && !isOneOf(rest[rest.size() - 2], {"the", "to"}) && (words.dropBack(), true);
  };
  while (words.rest().size() > 1 &&
         (words.takeBack({"gone",   "hiding", "located",     "kept",     "standing", "be",    "found",  "been", "got",
                          "gotten", "to",     "at",          "went",     "ended",    "end",   "up",     "put",  "placed",
                          "stored", "has",    "have",        "might",    "may",      "could", "can",    "is",   "are",
                          "lies",   "lying",  "disappeared", "vanished", "hidden",   "laid",  "sitting"}) ||
          left())) {
  }
}

/// "in the flat" says nothing about where.
bool takeInTheHome(WordCursor& words) {
  WordCursor ahead = words;
  const bool taken = ahead.take({"in", "inside"}) && ahead.take({"the", "this", "our", "my"}) &&
                     ahead.take({"house", "home", "flat", "apartment", "place"});
  words = taken ? ahead : words;
  return taken;
}

/// "has X been these days": all of its places, or the last where none is recorded.
bool readBeen(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (!ahead.take({"has", "have"})) {
    return false;
  }
  ahead.takeBack({"lately", "recently"}) || ahead.takeAllBack({"these", "days"});
  if (!ahead.takeBack({"been"})) {
    return false;
  }
  draft.words = ahead;
  (void)draft.finish(QuestionKind::kWhere);
  draft.otherwise = draft.question;
  return draft.finish(QuestionKind::kHistory);
}

}  // namespace

bool readStandGoal(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  takePurpose(words);
  if (words.takeAll({"get", "hold", "of"}) || words.takeAll({"take", "hold", "of"})) {
    return draft.finish(QuestionKind::kStand);
  }
  if (!words.take({"see",    "reach",   "open",  "close", "look", "grasp",   "get",    "use",   "grab",  "view",  "take", "pick",
                   "access", "inspect", "watch", "at",    "sees", "reaches", "grasps", "opens", "films", "fetch", "touch"})) {
    return false;
  }
  words.take({"at", "into", "up", "inside", "to"});
  if (words.take({"what"})) {
    words.takeBe() || words.take({"lies", "stands"});
    if (const auto relation = findRelationWords(words.rest()); relation) {
      words.drop(relation->count);
    }
  }
  return draft.finish(QuestionKind::kStand);
}

bool readWhere(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  (void)takeAdverbs(words);
  words.takeAll({"on", "earth"}) || words.takeAll({"the", "heck"}) || words.takeAll({"the", "hell"}) || takeInTheHome(words);
  if (words.takeAll({"have", "you"}) || words.takeAll({"did", "you"}) || words.takeAll({"has", "anyone"})) {
    words.take({"last", "ever"});
    words.takeIf(isSeeing) || words.take({"put", "leave", "left", "got"});
    words.takeBack({"last", "before"});
    return draft.finish(QuestionKind::kWhere);
  }
  if (readBeen(draft)) {
    return true;
  }
  words.takeBack({"lately", "recently"}) || words.takeAllBack({"these", "days"});
  const bool of_the_past = words.startsWith({"did"}) || words.startsWith({"have"}) || words.startsWith({"has"});
  bool modal = words.takeModal() || words.take({"might", "have", "has"});
  const bool speaker = words.takeSpeaker();
  modal = (speaker && words.takeModal()) || modal;  // "where I can find"
  if (speaker && (modal || words.take({"put", "left", "keep", "kept", "have"}))) {
    return readWhereSpeaker(draft, of_the_past);
  }
  if (modal && (words.takeIf(isSeeing) || words.takeAll({"look", "for"}))) {  // "where to find X"
    return draft.finish(QuestionKind::kWhere);
  }
  if (words.takeBack({"belong", "belongs"})) {
    words.takeIf(isBe);
    return draft.finish(QuestionKind::kUsualPlace);
  }
  if (modal && words.takeBack({"go", "live", "stay"})) {
    return draft.finish(of_the_past ? QuestionKind::kWhere : QuestionKind::kUsualPlace);
  }
  words.takeBe() || words.take({"would", "could", "should", "stays", "lives", "lies", "stands", "sits", "hides", "hangs"});
  takeWhereTail(words);
  if (words.takeBack({"usually", "normally", "supposed", "meant"}) || takeWord(draft, {"usually", "normally"})) {
    words.takeBack({"kept", "stored"});
    return draft.finish(QuestionKind::kUsualPlace);
  }
  words.takeBack({"stand", "lie", "sit", "hide"});
  return draft.finish(QuestionKind::kWhere);
}

bool readStand(QuestionDraft& draft) {
  draft.words.takeModal();
  draft.words.takeSpeaker();
  return readStandGoal(draft);
}

bool readWhichPlace(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::size_t be = words.find({"is", "are", "was", "were", "do", "does", "did", "can"});
  if (be == words.rest().size()) {
    return false;
  }
  words.drop(be + 1);
  words.takeSpeaker();
  words.take({"keep", "find", "put", "leave"});
  takeWhereTail(words);
  words.takeBack({"stand", "lie", "sit"});
  return draft.finish(QuestionKind::kWhere);
}

}  // namespace oikos::semantic
