// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/answer_context.h"

#include <algorithm>
#include <functional>

#include "semantic/history/home_state.h"
#include "semantic/query/grammar_words.h"
#include "semantic/query/sentence.h"

namespace oikos::semantic {

namespace {

/// As home.xml has it: seen there at that time, with that confidence.
BeliefPrior priorOf(const SmallObject& small, const Vocabulary& vocabulary) {
  BeliefPrior prior{small.default_places, vocabulary.halfLife_s(small.type), std::nullopt};
  if (small.last_seen_ns) {
    Event& seen = prior.first_seen.emplace();
    seen.subject = small.id.value;
    seen.kind = EventKind::kSighted;
    seen.time_ns = *small.last_seen_ns;
    seen.confidence = small.confidence.value_or(1.0);
    seen.after = Placement{small.parent, small.relation, small.T_parent_object};
  }
  return prior;
}

void setBelief(const Belief& belief, FoundThing& found) {
  constexpr double kLeastShown = 0.01;
  found.elsewhere = belief.elsewhere;
  found.confidence = 0.0;
  for (const PlaceProbability& place : belief.places) {
    if (place.place == Place{found.parent, found.relation.value_or(Relation::kOn)}) {
      found.confidence = place.probability;
    }
    if (place.probability >= kLeastShown) {
      found.expected_at.push_back(place);
    }
  }
}

}  // namespace

AnswerContext::AnswerContext(const Inquiry& inquiry, const Question& question)
    : inquiry_(inquiry), question_(question), clock_(inquiry.index->home().time_zone, inquiry.now_ns) {}

bool AnswerContext::goToTime() {
  if (!question_.time) {
    return true;
  }
  std::optional<TimeSpan> last_recording;
  if (question_.time->last_recording && history() != nullptr) {
    if (const auto recording = history()->findLastRecording()) {
      last_recording = TimeSpan{recording->first_ns, recording->last_ns + 1, false};
    }
  }
  span_ = resolveTime(*question_.time, clock_, last_recording);
  if (!span_) {
    nothingFits(question_.time->last_recording ? "No recording has been read yet." : "I know of no time '" + question_.time->words + "'.");
    return false;
  }
  if (span_->to_come) {
    nothingFits("'" + capitalised(question_.time->words) + "' is still to come.");
    return false;
  }
  const bool of_events = question_.kind == QuestionKind::kChanges || question_.kind == QuestionKind::kHistory ||
                         question_.kind == QuestionKind::kLastSeen || question_.kind == QuestionKind::kLastChange;
  if (of_events || span_->last_ns() >= clock_.now_ns()) {
    return true;
  }
  if (history() == nullptr) {
    nothingFits("I know of the present only: this home has no history.");
    return false;
  }
  answer.at_ns = span_->last_ns();
  past_.emplace(present(), std::make_shared<const Home>(homeAt(present().home(), *history(), span_->last_ns())));
  return true;
}

Resolution AnswerContext::resolve(const ThingPhrase& phrase) const {
  return Resolver(index(), present(), robot() ? std::optional(robot()->position_map_m) : std::nullopt).resolve(phrase);
}

std::optional<Things> AnswerContext::resolveThing() {
  resolution_ = resolve(question_.thing);
  answer.corrected = resolution_.corrected;
  if (!resolution_.known) {
    sayUnknown();
    return std::nullopt;
  }
  return resolution_.things;
}

std::optional<Things> AnswerContext::resolveSome() {
  std::optional<Things> things = resolveThing();
  if (things && things->empty()) {
    nothingFits();
    return std::nullopt;
  }
  return things;
}

std::optional<Things> AnswerContext::takeThose(const std::function<bool(const Thing&)>& fits, const std::string& otherwise) {
  std::optional<Things> things = resolveSome();
  if (!things) {
    return std::nullopt;
  }
  std::erase_if(*things, [&](const Thing* thing) { return !fits(*thing); });
  if (things->empty()) {
    nothingFits(otherwise);
    return std::nullopt;
  }
  take(*things);
  return things;
}

std::optional<Things> AnswerContext::takeOpenable() {
  return takeThose([](const Thing& thing) { return isOpen(thing).has_value(); },
                   "I know of no way to open the " + question_.thing.said + ".");
}

void AnswerContext::sayUnknown() {
  std::vector<std::string> nouns = resolution_.unknown;
  std::erase_if(nouns, [](const std::string& word) { return isGrammarWord(word); });
  if (nouns.empty()) {  // no thing that the home lacks: the question was not read rightly
    answer.status = AnswerStatus::kNotUnderstood;
    answer.not_understood = resolution_.unknown;
    answer.sentence = "I did not understand '" + resolution_.unknown.front() + "'.";
    return;
  }
  answer.status = AnswerStatus::kUnknownWord;
  answer.not_understood = nouns;
  for (const std::string& word : nouns) {
    const std::vector<std::string> near = index().words().nearestWords(word);
    answer.suggestions.insert(answer.suggestions.end(), near.begin(), near.end());
  }
  answer.sentence = "Nothing in this home is called '" + joined(nouns, "', '") + "'";
  answer.sentence += answer.suggestions.empty() ? "." : "; did you mean " + joined(answer.suggestions, " or ") + "?";
}

FoundThing AnswerContext::found(const Thing& thing) const {
  FoundThing described = describe(thing, robot());
  const bool is_joint = thing.kind == ThingKind::kPart && !described.joints.empty();
  remember(is_joint ? described.joints.front().id : described.id, thing, described);
  return described;
}

void AnswerContext::remember(const std::string& subject, const Thing& thing, FoundThing& described) const {
  std::function<BeliefPrior()> prior;
  if (thing.kind == ThingKind::kSmallObject) {
    prior = [&] { return priorOf(*thing.small_object, present().home().vocabulary); };
  }
  std::shared_ptr<const Recalled> recalled;
  if (!answer.at_ns && inquiry_.recollection != nullptr) {
    recalled = inquiry_.recollection->recall(subject, prior);
  }
  if (!recalled || recalled->newest_ns.value_or(moment_ns()) > moment_ns()) {
    const std::optional<BeliefPrior> made = prior ? std::optional(prior()) : std::nullopt;
    recalled = std::make_shared<const Recalled>(recallAt(history(), subject, made ? &*made : nullptr, moment_ns()));
  }
  if (const std::optional<Event>& event = recalled->state) {
    described.evidence = Evidence{event->number, event->recording, event->frame, event->evidence};
  }
  const auto* const looked = recalled->missed ? std::get_if<Placement>(&*recalled->missed->after) : nullptr;
  if (looked != nullptr && looked->parent == described.parent && looked->relation == described.relation) {
    described.missed_ns = recalled->missed->time_ns;
  }
  if (recalled->belief) {
    setBelief(recalled->belief->at(moment_ns()), described);
  }
}

void AnswerContext::take(const Things& things) {
  answer.status = AnswerStatus::kAnswered;
  answer.total = things.size();
  answer.found.clear();
  for (std::size_t i = 0; i < std::min(things.size(), kMostFound); ++i) {
    answer.found.push_back(found(*things[i]));
  }
}

void AnswerContext::nothingFits(std::string sentence) {
  answer.status = AnswerStatus::kNothingFits;
  if (!sentence.empty()) {
    answer.sentence = std::move(sentence);
    return;
  }
  const std::string asked = question_.thing.said.empty() ? "such thing" : question_.thing.said;
  if (!resolution_.missing_place.empty()) {
    answer.sentence = "I know of no " + resolution_.missing_place + ".";
  } else {
    answer.sentence = "I know of no " + asked;
    answer.sentence += resolution_.elsewhere > 0 ? "; " + std::to_string(resolution_.elsewhere) + " elsewhere." : ".";
  }
}

void AnswerContext::say(const std::string& sentence) {
  answer.sentence = capitalised(whenText() + sentence);
}

std::string AnswerContext::be(std::size_t number) const {
  if (answer.at_ns) {
    return number == 1 ? "was" : "were";
  }
  return number == 1 ? "is" : "are";
}

std::string AnswerContext::be(const Thing& thing) const {
  return be(isPlural(thing) ? std::size_t{2} : std::size_t{1});
}

std::string AnswerContext::whenText() const {
  if (!answer.at_ns) {
    return {};
  }
  const bool moment = span_->from_ns == span_->to_ns;
  return (moment ? clock_.text(*answer.at_ns) : clock_.dayText(*answer.at_ns)) + ", ";
}

}  // namespace oikos::semantic
