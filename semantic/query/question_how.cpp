// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

/// "X does Y have", "X has Y got".
bool readCountOfWhole(QuestionDraft& draft, Words noun) {
  WordCursor& words = draft.words;
  const bool has = words.take({"has", "have"});
  if (!has && !words.take({"do", "does", "did", "can"})) {
    return false;
  }
  if (!words.empty() && isSpeaker(words.front())) {
    words.takeSpeaker();
    words.take({"have", "see", "own", "keep", "count", "find"});
    words.take({"got", "left"});
    return false;
  }
  words.takeAllBack({"in", "it"}) || words.takeAllBack({"on", "it"});
  const bool ends = words.takeBack({"have", "contain", "hold", "own", "got"});
  if (noun.empty() || words.empty() || !(has || ends)) {
    return false;
  }
  draft.question.kind = QuestionKind::kCount;
  draft.question.thing = readThingPhrase(noun);
  addPlaces(draft.question.thing, {having(readThingPhrase(words.rest()))});
  return true;
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

/// After "how": "cold is X set", "hot is X".
bool readHowStrong(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (!ahead.take({"cold", "cool", "hot", "warm", "high", "low", "strong", "fast"}) || !ahead.takeBe()) {
    return false;
  }
  ahead.takeBack({"set", "turned", "running"}) || ahead.takeAllBack({"set", "to"}) || ahead.takeAllBack({"turned", "up"});
  draft.words = ahead;
  return draft.finish(QuestionKind::kSetting);
}

/// After "how am": "I supposed to open X".
bool readHowAm(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (!ahead.take({"am", "are", "is"}) || !ahead.takeSpeaker()) {
    return false;
  }
  ahead.take({"supposed", "meant", "expected", "going", "best"});
  if (!ahead.take({"to"})) {
    return false;
  }
  draft.words = ahead;
  return readHowTo(draft);
}

/// "open X", "get into X", "get X open"; an ending "ing" as well.
bool takeOpening(WordCursor& words) {
  WordCursor ahead = words;
  if (ahead.take({"get", "getting", "pull"}) && (ahead.takeBack({"open", "opened"}) || ahead.take({"into"}))) {
    words = ahead;
    return true;
  }
  return words.take({"open", "opening", "close", "closing", "shut", "unlock"});
}

bool takeGrasping(WordCursor& words) {
  if (words.takeAll({"get", "hold", "of"}) || words.takeAll({"take", "hold", "of"}) || words.takeAll({"get", "a", "grip", "on"})) {
    return true;
  }
  if (!words.take(
          {"grasp", "hold", "grab", "grip", "lift", "take", "pick", "picking", "grasping", "holding", "grabbing", "lifting", "handle"})) {
    return false;
  }
  words.takeBack({"up"});
  words.take({"up"});
  return true;
}

}  // namespace

bool readCount(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  words.takeAll({"of", "the"});
  const std::size_t verb =
      words.find({"is", "are", "was", "were", "do", "does", "did", "can", "have", "has", "lie", "stand", "sit", "hang"});
  const Words noun = words.rest().first(verb);
  words.drop(verb);
  if (noun.empty()) {
    return false;
  }
  if (readCountOfWhole(draft, noun)) {
    return true;
  }
  words.takeBe() || words.take({"lie", "stand", "sit", "hang"});
  words.take({"there"});
  words.takeBack({"have", "got", "left"});
  if (words.empty()) {
    draft.question.kind = QuestionKind::kCount;
    draft.question.thing = readThingPhrase(noun);
    return true;
  }
  const bool counted = draft.finishPredicate(readThingPhrase(noun), words);
  if (counted && draft.question.kind == QuestionKind::kWhichState) {
    draft.question.thing.open = draft.question.state == "open";
    if (draft.question.state != "open" && draft.question.state != "closed") {
      return false;
    }
  }
  draft.question.kind = QuestionKind::kCount;
  draft.question.state.clear();
  return counted;
}

bool readHowTo(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  words.takeSpeaker() || words.takeAll({"your"});
  words.take({"gripper", "arm", "hand"});
  words.take({"best", "have"});
  words.take({"to"});
  if (takeOpening(words)) {
    return draft.finish(QuestionKind::kHowOpen);
  }
  if (takeGrasping(words)) {
    return draft.finish(QuestionKind::kHowGrasp);
  }
  if (words.takeAll({"get", "to"}) || words.takeAll({"get", "at"}) || words.take({"reach", "approach"})) {
    return draft.finish(QuestionKind::kStand);
  }
  return words.take({"get", "fetch", "bring"}) && draft.finish(QuestionKind::kFetch);
}

bool readHowFar(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"away", "out"})) {
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
  while (words.takeBack({"open", "opened", "out", "pulled", "ajar", "closed", "shut", "turned", "stands", "standing"})) {
  }
  return draft.finish(QuestionKind::kHowFar);
}

bool readHow(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.startsWith({"much"}) && words.rest().size() > 1 && isBe(words.rest()[1]) &&
      isOneOf(words.back(), {"open", "opened", "out", "ajar"})) {
    words.drop();
    return readHowFar(draft);
  }
  if (words.take({"many", "much"})) {
    return readCount(draft);
  }
  if (words.takeAll({"long", "ago"}) || words.takeAll({"recently"})) {
    return readWhen(draft);
  }
  if (words.take({"far", "wide"})) {
    return readHowFar(draft);
  }
  if (readHowStrong(draft)) {
    return true;
  }
  if (readHowAm(draft)) {
    return true;
  }
  if (words.takeBe()) {
    return readHowIs(draft);
  }
  return words.takeModal() && readHowTo(draft);
}

bool readWhen(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  const bool is = words.startsWith({"is"}) || words.startsWith({"was"});
  if (is && (words.drop(), words.take({"the"}), words.takeAll({"last", "time"}))) {
    words.take({"that", "when"});
  }
  if (!words.takeModal() && !words.takeBe()) {
    words.take({"have", "has"});
  }
  words.takeSpeaker();
  words.take({"have", "had", "has"});
  words.take({"last"}) || words.takeAll({"most", "recently"});
  if (words.takeIf(isSeeing)) {
    words.takeBack({"last"}) || words.takeBack({"most", "recently"}) || words.takeAllBack({"last", "time"});
    return draft.finish(QuestionKind::kLastSeen);
  }
  const std::string first = words.empty() ? "" : words.front();
  if (words.take({"move", "open", "close", "change", "moved", "opened", "closed", "changed", "use", "used"})) {
    return draft.finishChange(first);
  }
  words.takeBack({"last"}) || words.takeAllBack({"last", "time"});
  if (!words.empty() && isSeeing(words.back())) {
    words.dropBack();
    words.takeBack({"last"});
    words.takeBack({"been"});
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
