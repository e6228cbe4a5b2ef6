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

/// "reach X", "see what is in X".
bool readStandGoal(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (!words.take({"see", "reach", "open", "close", "look", "grasp", "get", "use", "grab", "view", "take", "pick", "access", "inspect",
                   "watch", "at"})) {
    return false;
  }
  words.take({"at", "into", "up", "inside"});
  if (words.take({"what"})) {
    words.takeBe() || words.take({"lies", "stands"});
    if (const auto relation = findRelationWords(words.rest()); relation) {
      words.drop(relation->count);
    }
  }
  return draft.finish(QuestionKind::kStand);
}

/// After "where do I", "where did you".
bool readWhereSpeaker(QuestionDraft& draft, bool of_the_past) {
  WordCursor& words = draft.words;
  words.take({"last", "usually", "normally"});
  if (words.take({"stand", "park", "go", "be", "drive", "position", "stay", "wait", "place", "move"}) && words.take({"to", "for"})) {
    return readStandGoal(draft);
  }
  if (words.take({"put", "store", "return"})) {
    words.takeBack({"back", "away"});
    return draft.finish(of_the_past ? QuestionKind::kWhere : QuestionKind::kUsualPlace);
  }
  words.takeIf(isSeeing) || words.take({"leave", "left", "put", "get", "have", "keep"});
  words.takeBack({"last"});
  return draft.finish(QuestionKind::kWhere);
}

}  // namespace

bool readWhere(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.takeAll({"have", "you"}) || words.takeAll({"did", "you"}) || words.takeAll({"has", "anyone"})) {
    words.take({"last", "ever"});
    words.takeIf(isSeeing) || words.take({"put", "leave", "left"});
    words.takeBack({"last", "before"});
    return draft.finish(QuestionKind::kWhere);
  }
  const bool of_the_past = words.startsWith({"did"});
  const bool modal = words.takeModal();
  const bool speaker = words.takeSpeaker();
  if (modal && speaker) {
    return readWhereSpeaker(draft, of_the_past);
  }
  if (words.takeBack({"belong", "belongs"})) {
    words.takeIf(isBe);
    return draft.finish(QuestionKind::kUsualPlace);
  }
  if (modal && words.takeBack({"go", "live", "stay"})) {
    return draft.finish(of_the_past ? QuestionKind::kWhere : QuestionKind::kUsualPlace);
  }
  words.takeBe() || words.take({"has", "have", "might", "would", "could", "can", "should"});
  words.takeBack({"gone", "hiding", "located", "kept", "standing", "be", "found", "been"});
  if (words.takeBack({"usually", "normally", "supposed", "meant"}) || takeWord(draft, {"usually", "normally"})) {
    words.takeBack({"kept", "stored"});
    return draft.finish(QuestionKind::kUsualPlace);
  }
  return draft.finish(QuestionKind::kWhere);
}

bool readStand(QuestionDraft& draft) {
  draft.words.takeModal();
  draft.words.takeSpeaker();
  return readStandGoal(draft);
}

bool readWhichPlace(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::size_t be = words.find({"is", "are", "was", "were", "do", "did", "can"});
  if (be == words.rest().size()) {
    return false;
  }
  words.drop(be + 1);
  words.takeSpeaker();
  words.take({"keep", "find", "put", "leave"});
  return draft.finish(QuestionKind::kWhere);
}

}  // namespace oikos::semantic
