// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question.h"

#include <string>
#include <utility>

#include "semantic/query/question_draft.h"
#include "semantic/query/question_kinds.h"
#include "semantic/query/time_words.h"

namespace oikos::semantic {

namespace {

/// "could you bring me X", "will you please fetch X".
void skipRequest(WordCursor& words) {
  WordCursor ahead = words;
  if (ahead.take({"can", "could", "would", "will"}) && ahead.take({"you", "anyone", "anybody", "someone", "somebody"})) {
    while (ahead.take({"please", "kindly", "possibly", "quickly", "just"})) {
    }
    ahead.take({"mind"});
    words = !ahead.empty() && !isSeeing(ahead.front()) ? ahead : words;
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
  if (size > 2 && rest[size - 1] == "where" && isBe(rest[size - 2])) {  // "the cup is where"
    words.dropBack(2);
    return true;
  }
  return false;
}

/// "from which spot", "from what position".
bool takeFromWhichSpot(WordCursor& words) {
  WordCursor ahead = words;
  const bool taken =
      ahead.take({"from", "at"}) && ahead.take({"which", "what"}) && ahead.take({"spot", "position", "pose", "point", "place"});
  words = taken ? ahead : words;
  return taken;
}

/// "on the desk, what is there?"
bool takeTrailingWhat(WordCursor& words) {
  return findRelationWords(words.rest()) && words.rest().size() > 4 &&
         (words.takeAllBack({"what", "is", "there"}) || words.takeAllBack({"what", "is", "in", "there"}) ||
          words.takeAllBack({"what", "do", "you", "see"}));
}

/// "in which", "on what".
bool takeWhichOf(WordCursor& words) {
  WordCursor ahead = words;
  const bool taken = ahead.take({"in", "on", "at", "under", "inside"}) && ahead.take({"which", "what"});
  words = taken ? ahead : words;
  return taken;
}

bool readKind(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (takeTrailingWhere(words)) {
    return draft.finish(QuestionKind::kWhere);
  }
  if (takeTrailingWhat(words)) {
    return draft.finish(QuestionKind::kContents);
  }
  if (words.take({"where", "whereabouts"})) {
    return readWhere(draft);
  }
  if (words.takeAll({"from", "where"})) {
    return readStand(draft);
  }
  if (words.takeAll({"by", "how", "much"}) || words.takeAll({"by", "how", "many", "degrees"}) ||
      words.takeAll({"how", "many", "degrees"})) {
    return readHowFar(draft);
  }
  if (words.take({"how"})) {
    return readHow(draft);
  }
  if (words.take({"when"}) || words.takeAll({"at", "what", "time"}) || words.takeAll({"what", "time"})) {
    return readWhen(draft);
  }
  if (takeFromWhichSpot(words)) {
    return readStand(draft);
  }
  if (takeWhichOf(words)) {
    return readWhichPlace(draft);
  }
  if (words.takeAll({"what", "number", "of"})) {
    return readCount(draft);
  }
  if (words.take({"what", "which"})) {
    return readWhat(draft);
  }
  if (words.takeAll({"number", "of"}) || words.takeAll({"the", "number", "of"}) || words.take({"count"})) {
    return draft.finish(QuestionKind::kCount);
  }
  return readNamed(draft) || readYesNo(draft) || readCommand(draft) || readSentence(draft);
}

bool mayBeOfAnything(QuestionKind kind) {
  return kind == QuestionKind::kChanges || kind == QuestionKind::kWhatFor || kind == QuestionKind::kWhichState ||
         kind == QuestionKind::kIsState;
}

ParsedQuestion readQuestion(Words words) {
  QuestionDraft draft{WordCursor(words)};
  skipRequest(draft.words);
  const std::string first = draft.words.empty() ? "" : draft.words.front();
  if (readKind(draft) && (!draft.question.thing.empty() || mayBeOfAnything(draft.question.kind))) {
    return {std::move(draft.question), std::move(draft.otherwise), draft.is_statement, {}};
  }
  return {std::nullopt, std::nullopt, false, draft.words.empty() ? first : draft.words.front()};
}

/// "is the thermostat at 3": a setting, not a time; who asks after a time says "was".
std::optional<Question> readNumberSet(Words words) {
  WordCursor ahead(words);
  std::string state;
  if (ahead.takeBack({"degrees"})) {
    state = " degrees";
  }
  if (ahead.rest().size() < 4 || !isOneOf(ahead.front(), {"is", "are"}) || !wholeNumber(ahead.back())) {
    return std::nullopt;
  }
  state.insert(0, ahead.back());
  ahead.dropBack();
  QuestionDraft draft{ahead};
  draft.words.drop();
  if (!draft.words.takeBack({"at", "on"})) {
    return std::nullopt;
  }
  draft.words.takeBack({"set", "turned", "switched"});
  draft.question.state = state;
  return draft.finish(QuestionKind::kIsState) ? std::optional(std::move(draft.question)) : std::nullopt;
}

}  // namespace

ParsedQuestion parseQuestion(const std::vector<std::string>& words) {
  if (auto question = readNumberSet(words)) {
    return {std::move(question), std::nullopt, false, {}};
  }
  TimeReading reading = readTime(words);
  ParsedQuestion parsed = readQuestion(reading.rest);
  if (parsed.question) {
    if (parsed.otherwise) {
      parsed.otherwise->time = reading.time;
    }
    parsed.question->time = std::move(reading.time);
  }
  return parsed;
}

}  // namespace oikos::semantic
