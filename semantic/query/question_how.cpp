// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

/// After "how many": "X", "X are there", "X are on Y", "X does Y have", "X do we have", "X are open".
bool readCount(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const std::size_t verb = words.find({"is", "are", "was", "were", "do", "does", "did", "can", "have", "has", "lie", "stand", "sit"});
  const Words noun = words.rest().first(verb);
  words.drop(verb);
  const bool modal = words.takeModal();
  if (modal && words.takeBack({"have", "contain", "hold", "own"}) && !words.empty() && !isSpeaker(words.front())) {
    draft.question.kind = QuestionKind::kCount;
    draft.question.thing = readThingPhrase(noun);
    draft.question.thing.whole.push_back(readThingPhrase(words.rest()));
    return !noun.empty();
  }
  if (modal) {
    words.takeSpeaker();
    words.take({"have", "see", "own"});
    words.take({"got"});
  } else if (!words.takeBe()) {
    words.take({"have", "has", "lie", "stand", "sit"});
  }
  words.take({"there"});
  draft.edited.assign(noun.begin(), noun.end());
  if (!words.empty()) {
    draft.edited.emplace_back("that");
  }
  draft.edited.insert(draft.edited.end(), words.rest().begin(), words.rest().end());
  words = WordCursor(draft.edited);
  words.takeBack({"that", "have", "got"});
  return !noun.empty() && draft.finish(QuestionKind::kCount);
}

/// After "how far": "is X open", "open is X", "is X from Y".
bool readHowFar(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"away"})) {
    words.takeBe();
  }
  words.take({"open", "opened"});
  words.takeBe() || words.take({"did"});
  const std::size_t from = words.find({"from"});
  if (from > 0 && from + 1 < words.rest().size()) {
    draft.question.other = readThingPhrase(words.rest().subspan(from + 1));
    words = WordCursor(words.rest().first(from));
    words.takeBack({"away"});
    return draft.finish(QuestionKind::kDistance);
  }
  while (words.takeBack({"open", "opened", "out", "pulled", "ajar", "closed", "shut", "turned"})) {
  }
  return draft.finish(QuestionKind::kHowFar);
}

/// After "how is": "X opened", "X held", "X set".
bool readHowIs(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.takeBack({"opened", "open"})) {
    return draft.finish(QuestionKind::kHowOpen);
  }
  if (words.takeBack({"grasped", "held", "grabbed"})) {
    return draft.finish(QuestionKind::kHowGrasp);
  }
  return words.takeBack({"set"}) && draft.finish(QuestionKind::kSetting);
}

/// After "how do": "I open X", "I pick up X", "I get to X", "I fetch X".
bool readHowTo(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  words.takeSpeaker();
  if (words.take({"open", "close", "shut", "unlock"})) {
    return draft.finish(QuestionKind::kHowOpen);
  }
  if (words.take({"grasp", "hold", "grab", "grip", "lift", "take"}) || words.takeAll({"pick", "up"})) {
    words.takeBack({"up"});
    return draft.finish(QuestionKind::kHowGrasp);
  }
  if (words.takeAll({"get", "to"}) || words.take({"reach", "approach"})) {
    return draft.finish(QuestionKind::kStand);
  }
  return words.take({"get", "fetch", "bring"}) && draft.finish(QuestionKind::kFetch);
}

}  // namespace

bool readHow(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"many", "much"})) {
    return readCount(draft);
  }
  if (words.takeAll({"long", "ago"})) {
    return readWhen(draft);
  }
  if (words.take({"far", "wide"})) {
    return readHowFar(draft);
  }
  if (words.takeBe()) {
    return readHowIs(draft);
  }
  return words.takeModal() && readHowTo(draft);
}

bool readWhen(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (!words.takeModal() && !words.takeBe()) {
    words.take({"have", "has"});
  }
  words.takeSpeaker();
  words.take({"last"});
  if (words.takeIf(isSeeing)) {
    words.takeBack({"last"});
    return draft.finish(QuestionKind::kLastSeen);
  }
  const std::string first = words.empty() ? "" : words.front();
  if (words.take({"move", "open", "close", "change", "moved", "opened", "closed", "changed", "use", "used"})) {
    return draft.finishChange(first);
  }
  words.takeBack({"last"});
  if (!words.empty() && isSeeing(words.back())) {
    words.dropBack();
    words.takeBack({"last"});
    return draft.finish(QuestionKind::kLastSeen);
  }
  const std::string last = words.empty() ? "" : words.back();
  if (words.takeBack({"moved", "opened", "closed", "changed", "set", "used", "shut", "move", "change", "put", "open"})) {
    words.takeBack({"last", "been"});
    return draft.finishChange(last);
  }
  return false;
}

}  // namespace oikos::semantic
