// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/answer.h"

#include "semantic/query/answer_context.h"
#include "semantic/query/sentence.h"
#include "semantic/query/thing_phrase.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

using Answerer = void (*)(AnswerContext&);

Answerer answererOf(QuestionKind kind) {
  switch (kind) {
    case QuestionKind::kWhere:
      return answerWhere;
    case QuestionKind::kUsualPlace:
      return answerUsualPlace;
    case QuestionKind::kContents:
      return answerContents;
    case QuestionKind::kCount:
      return answerCount;
    case QuestionKind::kIsThere:
      return answerIsThere;
    case QuestionKind::kIsState:
      return answerIsState;
    case QuestionKind::kWhichState:
      return answerWhichState;
    case QuestionKind::kHowFar:
      return answerHowFar;
    case QuestionKind::kSetting:
      return answerSetting;
    case QuestionKind::kLastSeen:
      return answerLastSeen;
    case QuestionKind::kLastChange:
      return answerLastChange;
    case QuestionKind::kChanges:
      return answerChanges;
    case QuestionKind::kHistory:
      return answerHistory;
    case QuestionKind::kStand:
      return answerStand;
    case QuestionKind::kHowOpen:
      return answerHowOpen;
    case QuestionKind::kHowGrasp:
      return answerHowGrasp;
    case QuestionKind::kUse:
      return answerUse;
    case QuestionKind::kWhatFor:
      return answerWhatFor;
    case QuestionKind::kFetch:
      return answerFetch;
    case QuestionKind::kProperty:
      return answerProperty;
    case QuestionKind::kDistance:
      break;
  }
  return answerDistance;
}

Answer refusal(std::string sentence, const std::string& word = {}) {
  Answer answer;
  answer.sentence = std::move(sentence);
  if (!word.empty()) {
    answer.not_understood.push_back(word);
  }
  return answer;
}

Answer notUnderstood(const std::string& word) {
  return refusal(word.empty() ? "I did not understand the question." : "I did not understand '" + word + "'.", word);
}

/// A noun alone asks where that is; as long as every word of it is one of the home's.
std::optional<Question> nounAlone(const Inquiry& inquiry, const std::vector<std::string>& words) {
  Question question;
  question.thing = readThingPhrase(words);
  if (question.thing.words.empty()) {
    return std::nullopt;
  }
  const Resolution meant = Resolver(*inquiry.index, *inquiry.index, std::nullopt).resolve(question.thing);
  const bool sure = meant.known && meant.corrected.empty() && !meant.things.empty();
  return sure ? std::optional(std::move(question)) : std::nullopt;
}

}  // namespace

Answer answerQuestion(const Inquiry& inquiry, std::string_view text) {
  if (text.size() > kMostQuestionBytes) {
    return refusal("The question is too long: at most " + std::to_string(kMostQuestionBytes) + " bytes.");
  }
  std::vector<std::string> words = wordsOf(text);
  if (words.size() > kMostWords) {
    return refusal("The question is too long: at most " + std::to_string(kMostWords) + " words.");
  }
  words = inquiry.index->words().joinNames(words);
  ParsedQuestion parsed = parseQuestion(words);
  if (!parsed.question) {
    parsed.question = nounAlone(inquiry, words);
  }
  if (!parsed.question) {
    return notUnderstood(parsed.not_understood);
  }
  AnswerContext ctx(inquiry, *parsed.question);
  if (ctx.goToTime()) {
    answererOf(parsed.question->kind)(ctx);
  }
  return std::move(ctx.answer);
}

}  // namespace oikos::semantic
