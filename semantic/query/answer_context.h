// SPDX-License-Identifier: Apache-2.0
// What the kinds of answers share while one question is answered.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "semantic/query/answer.h"
#include "semantic/query/home_clock.h"
#include "semantic/query/question.h"
#include "semantic/query/resolver.h"

namespace oikos::semantic {

class AnswerContext {
 public:
  AnswerContext(const Inquiry& inquiry, const Question& question);

  /// Goes to the time of the question. False: that cannot be; the answer says why.
  [[nodiscard]] bool goToTime();

  [[nodiscard]] const Question& question() const { return question_; }
  /// Of the time of the question.
  [[nodiscard]] const HomeIndex& index() const { return past_ ? *past_ : *inquiry_.index; }
  [[nodiscard]] const HomeIndex& present() const { return *inquiry_.index; }
  [[nodiscard]] const History* history() const { return inquiry_.history; }
  [[nodiscard]] const HomeClock& clock() const { return clock_; }
  [[nodiscard]] const std::optional<TimeSpan>& span() const { return span_; }
  [[nodiscard]] const std::optional<RobotPlace>& robot() const { return inquiry_.robot; }
  [[nodiscard]] std::int64_t moment_ns() const { return answer.at_ns.value_or(inquiry_.now_ns); }

  [[nodiscard]] Resolution resolve(const ThingPhrase& phrase) const;
  /// That of the question's thing, with its unknown words said; nothing: the answer is complete.
  [[nodiscard]] std::optional<Things> resolveThing();
  /// The same, but never none: then the answer says so, and is complete.
  [[nodiscard]] std::optional<Things> resolveSome();
  /// Those of them that fit, taken into the answer. Nothing: the answer is complete; where there are things that do not fit, it is
  /// `otherwise`.
  [[nodiscard]] std::optional<Things> takeThose(const std::function<bool(const Thing&)>& fits, const std::string& otherwise);
  /// takeThose() of what can be opened.
  [[nodiscard]] std::optional<Things> takeOpenable();
  /// The last resolution of the question's thing.
  [[nodiscard]] const Resolution& resolution() const { return resolution_; }

  void take(const Things& things);
  [[nodiscard]] FoundThing found(const Thing& thing) const;
  void nothingFits(std::string sentence = {});
  void say(const std::string& sentence);
  /// "is", "are", "was", "were".
  [[nodiscard]] std::string be(std::size_t number) const;
  [[nodiscard]] std::string be(const Thing& thing) const;
  /// "yesterday at 8:00, "; empty: the present.
  [[nodiscard]] std::string whenText() const;

  Answer answer;

 private:
  void sayUnknown();
  void remember(const std::string& subject, const Thing& thing, FoundThing& described) const;

  const Inquiry& inquiry_;
  const Question& question_;
  HomeClock clock_;
  std::optional<TimeSpan> span_;
  std::optional<HomeIndex> past_;
  Resolution resolution_;
};

constexpr std::size_t kMostFound = 20;

// One file a family; each makes ctx.answer.
void answerWhere(AnswerContext& ctx);
void answerUsualPlace(AnswerContext& ctx);
void answerContents(AnswerContext& ctx);
void answerCount(AnswerContext& ctx);
void answerIsThere(AnswerContext& ctx);
void answerProperty(AnswerContext& ctx);
void answerDistance(AnswerContext& ctx);
void answerIsState(AnswerContext& ctx);
void answerWhichState(AnswerContext& ctx);
void answerHowFar(AnswerContext& ctx);
void answerSetting(AnswerContext& ctx);
void answerLastSeen(AnswerContext& ctx);
void answerLastChange(AnswerContext& ctx);
void answerChanges(AnswerContext& ctx);
void answerHistory(AnswerContext& ctx);
void answerStand(AnswerContext& ctx);
void answerHowOpen(AnswerContext& ctx);
void answerHowGrasp(AnswerContext& ctx);
void answerUse(AnswerContext& ctx);
void answerWhatFor(AnswerContext& ctx);
void answerFetch(AnswerContext& ctx);

}  // namespace oikos::semantic
