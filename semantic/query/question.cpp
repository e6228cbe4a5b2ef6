// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question.h"

#include <string>
#include <utility>

#include "semantic/query/question_draft.h"
#include "semantic/query/question_kinds.h"

namespace oikos::semantic {

namespace {

void skipPoliteness(WordCursor& words) {
  while (words.take({"please", "hey", "hello", "hi", "ok", "okay", "oikos", "so", "and", "well", "quick", "quickly", "say", "um", "oh",
                     "sorry", "excuse", "thanks"}) ||
         words.takeAll({"tell", "me"}) || words.takeAll({"can", "you", "tell", "me"}) || words.takeAll({"could", "you"}) ||
         words.takeAll({"would", "you"}) || words.takeAll({"will", "you"}) || words.takeAll({"do", "you", "know"}) ||
         words.takeAll({"do", "you", "remember"}) || words.takeAll({"any", "idea"}) || words.takeAll({"i", "wonder"}) ||
         words.takeAll({"i", "want", "to", "know"}) || words.takeAll({"let", "me", "know"}) || words.takeAll({"if"}) ||
         words.takeAll({"whether"}) || words.takeAll({"id", "like", "to", "know"}) || words.takeAll({"i", "would", "like", "to", "know"}) ||
         words.takeAll({"i", "forgot"}) || words.takeAll({"remind", "me"})) {
  }
  while (words.takeBack({"please", "thanks", "again", "then", "exactly", "right"})) {
  }
  if (words.startsWith({"can", "you"}) && words.rest().size() > 2 && !isSeeing(words.rest()[2])) {
    words.drop(2);
  }
}

/// "the cup on the table, where is it?"
bool takeTrailingWhere(WordCursor& words) {
  const Words rest = words.rest();
  const std::size_t size = rest.size();
  if (size > 3 && rest[size - 3] == "where" && isBe(rest[size - 2]) && isOneOf(rest[size - 1], {"it", "they", "that", "those"})) {
    words.dropBack(3);
    return true;
  }
  return false;
}

bool readKind(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (takeTrailingWhere(words)) {
    return draft.finish(QuestionKind::kWhere);
  }
  if (words.take({"where", "wheres"})) {
    return readWhere(draft);
  }
  if (words.takeAll({"from", "where"})) {
    return readStand(draft);
  }
  if (words.take({"how"})) {
    return readHow(draft);
  }
  if (words.take({"when"})) {
    return readWhen(draft);
  }
  if (words.takeAll({"in", "which"}) || words.takeAll({"in", "what"}) || words.takeAll({"on", "which"}) || words.takeAll({"on", "what"})) {
    return readWhichPlace(draft);
  }
  if (words.take({"what", "which", "whats"})) {
    return readWhat(draft);
  }
  if (words.takeAll({"number", "of"}) || words.takeAll({"the", "number", "of"}) || words.take({"count"})) {
    return draft.finish(QuestionKind::kCount);
  }
  return readYesNo(draft) || readCommand(draft) || readSentence(draft);
}

bool mayBeOfAnything(QuestionKind kind) {
  return kind == QuestionKind::kChanges || kind == QuestionKind::kWhatFor || kind == QuestionKind::kWhichState;
}

ParsedQuestion readQuestion(Words words) {
  QuestionDraft draft{WordCursor(words)};
  skipPoliteness(draft.words);
  const std::string first = draft.words.empty() ? "" : draft.words.front();
  if (readKind(draft) && (!draft.question.thing.empty() || mayBeOfAnything(draft.question.kind))) {
    return {std::move(draft.question), draft.is_statement, {}};
  }
  return {std::nullopt, false, draft.words.empty() ? first : draft.words.front()};
}

}  // namespace

ParsedQuestion parseQuestion(const std::vector<std::string>& words) {
  TimeReading reading = readTime(words);
  ParsedQuestion parsed = readQuestion(reading.rest);
  if (parsed.question) {
    parsed.question->time = std::move(reading.time);
  }
  return parsed;
}

}  // namespace oikos::semantic
