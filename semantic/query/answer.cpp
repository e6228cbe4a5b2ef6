// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/answer.h"

#include "semantic/query/answer_context.h"
#include "semantic/query/sentence.h"
#include "semantic/query/utterance.h"
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

Answer answerTo(const Inquiry& inquiry, const Question& question) {
  AnswerContext ctx(inquiry, question);
  if (ctx.goToTime()) {
    answererOf(question.kind)(ctx);
  }
  return std::move(ctx.answer);
}

/// The less the surer that the question was understood.
int doubtsAbout(const Answer& answer) {
  const bool guessed = !answer.corrected.empty();
  switch (answer.status) {
    case AnswerStatus::kAnswered:
      return guessed ? 2 : 0;
    case AnswerStatus::kNothingFits:
      return guessed ? 3 : 1;
    case AnswerStatus::kUnknownWord:
      return 4;
    case AnswerStatus::kNotUnderstood:
      break;
  }
  return 5;
}

Answer answerTo(const Inquiry& inquiry, const Hearing& heard) {
  if (!heard.parsed.question) {
    return notUnderstood(heard.parsed.not_understood);
  }
  Answer answer = answerTo(inquiry, *heard.parsed.question);
  if (heard.parsed.otherwise && answer.status != AnswerStatus::kAnswered) {
    Answer otherwise = answerTo(inquiry, *heard.parsed.otherwise);
    if (doubtsAbout(otherwise) < doubtsAbout(answer)) {
      answer = std::move(otherwise);
    }
  }
  answer.not_understood.insert(answer.not_understood.end(), heard.passed_over.begin(), heard.passed_over.end());
  return answer;
}

}  // namespace

Answer answerQuestion(const Inquiry& inquiry, std::string_view text) {
  if (text.size() > kMostQuestionBytes) {
    return refusal("The question is too long: at most " + std::to_string(kMostQuestionBytes) + " bytes.");
  }
  const Utterance utterance(*inquiry.index, text);
  if (utterance.words() > kMostWords) {
    return refusal("The question is too long: at most " + std::to_string(kMostWords) + " words.");
  }
  Answer answer = answerTo(inquiry, utterance.asOne());
  if (doubtsAbout(answer) == 0) {
    return answer;
  }
  for (const Hearing& heard : utterance.asClauses()) {
    Answer other = answerTo(inquiry, heard);
    if (doubtsAbout(other) < doubtsAbout(answer)) {
      answer = std::move(other);
    }
  }
  return answer;
}

}  // namespace oikos::semantic
