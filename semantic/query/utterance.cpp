// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/utterance.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "semantic/query/grammar_words.h"
#include "semantic/query/resolver.h"
#include "semantic/query/spoken.h"
#include "semantic/query/thing_phrase.h"
#include "semantic/query/word_cursor.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

bool isPronoun(std::string_view word) {
  return isOneOf(word, {"it", "they", "them"});
}

/// Says of something else that it is not meant, or meant instead.
bool changesMeaning(std::string_view word) {
  return isOneOf(word, {"not", "but", "except", "without", "unless", "only", "instead", "rather", "other", "otherwise", "no", "nor",
                        "never", "one", "ones", "mean", "meant", "before", "after"});
}

bool isOfSpeaker(const std::vector<std::string>& clause) {
  return isOneOf(clause.front(), {"i", "we", "me"});
}

bool hasPronoun(const std::vector<std::string>& clause) {
  return std::any_of(clause.begin(), clause.end(), isPronoun);
}

/// "put the cup on the table", "open the fridge", but not "open doors": what Oikos does not do.
bool isOrder(Words words) {
  const std::string& verb = words.front();
  const bool names_open = opennessOf(verb) && words.size() > 1 && !isFiller(words[1]);
  return isGrammarWord(verb) && !isFiller(verb) && !names_open;
}

/// With the thing in the place of the pronoun.
std::vector<std::string> spelledOut(const std::vector<std::string>& clause, const std::vector<std::string>& thing) {
  std::vector<std::string> words;
  for (const std::string& word : clause) {
    if (isPronoun(word)) {
      words.insert(words.end(), thing.begin(), thing.end());
    } else {
      words.push_back(word);
    }
  }
  return words;
}

/// "whre": as long as nothing is called so.
void mendQuestionWord(const HomeWords& home, std::string& word) {
  constexpr std::array<std::string_view, 4> asking{"where", "what", "which", "when"};
  if (word.size() < 4 || isGrammarWord(word) || home.knows(word)) {
    return;
  }
  const auto meant = std::find_if(asking.begin(), asking.end(), [&](std::string_view one) { return isOneSlipAway(word, one); });
  word = meant == asking.end() ? word : std::string(*meant);
}

/// "what is the oven temperature", "thermostat": of knobs the setting is asked for, not the place.
void askForSetting(const HomeIndex& index, Question& question) {
  const ThingPhrase& thing = question.thing;
  if (question.kind != QuestionKind::kWhere || thing.nearest || !thing.places.empty()) {
    return;
  }
  const Resolution meant = Resolver(index, index, std::nullopt).resolve(thing);
  if (!meant.things.empty() &&
      std::all_of(meant.things.begin(), meant.things.end(), [](const Thing* one) { return one->kind == ThingKind::kKnob; })) {
    question.kind = QuestionKind::kSetting;
  }
}

}  // namespace

Utterance::Utterance(const HomeIndex& index, std::string_view text) : index_(index) {
  const HomeWords& home = index.words();
  for (const std::string_view part : clausesOf(text)) {
    Clause said = home.joinNames(spokenOut(wordsOf(part)));
    if (!said.empty()) {
      mendQuestionWord(home, said.front());
    }
    words_ += said.size();
    first_word_ = first_word_.empty() && !said.empty() ? said.front() : first_word_;
    if (words_ > kMostWords) {
      return;
    }
    if (!clauses_.empty() && (isTag(said) || home.isSurplus(said))) {
      tagged_ = tagged_ || isTag(said);
      continue;
    }
    Words meant = home.withoutSurplus(said);
    if (const std::size_t tag = tagAtBack(meant); tag > 0) {
      tagged_ = true;
      meant = meant.first(meant.size() - tag);
    }
    if (!meant.empty()) {
      clauses_.emplace_back(meant.begin(), meant.end());
    }
  }
}

/// A noun alone asks where that is; as long as every word of it is one of the home's.
ParsedQuestion Utterance::parse(const Clause& clause) const {
  Clause words = clause;
  dropDoubt(words, tagged_);
  ParsedQuestion parsed = parseQuestion(words);
  if (parsed.question) {
    if (words.front() == "what") {
      askForSetting(index_, *parsed.question);
    }
    return parsed;
  }
  Question question;
  question.thing = readThingPhrase(words);
  if (question.thing.words.empty() || isOrder(words)) {
    return parsed;
  }
  const Resolution meant = Resolver(index_, index_, std::nullopt).resolve(question.thing);
  if (meant.known && meant.corrected.empty() && !meant.things.empty()) {
    parsed.question = std::move(question);
    askForSetting(index_, *parsed.question);
  }
  return parsed;
}

Hearing Utterance::asOne() const {
  if (clauses_.empty()) {
    return {{std::nullopt, std::nullopt, false, first_word_}, {}};
  }
  Clause words = clauses_.front();
  for (std::size_t i = 1; i < clauses_.size(); ++i) {
    words.insert(words.end(), clauses_[i].begin(), clauses_[i].end());
  }
  return {parse(words), {}};
}

/// The clauses, and those that nothing but "I" parts: "where is my diary i left it somewhere".
std::vector<Utterance::Clause> Utterance::remarksApart() const {
  std::vector<Clause> apart;
  for (const Clause& clause : clauses_) {
    const auto starts_remark = [&](std::size_t i) {
      return i >= 2 && i + 1 < clause.size() && isOneOf(clause[i], {"i", "we"}) && index_.words().knows(clause[i - 1]) &&
             !isGrammarWord(clause[i - 1]);
    };
    std::size_t start = 0;
    for (std::size_t i = 0; i < clause.size(); ++i) {
      if (starts_remark(i)) {
        apart.emplace_back(clause.begin() + static_cast<std::ptrdiff_t>(start), clause.begin() + static_cast<std::ptrdiff_t>(i));
        start = i;
      }
    }
    apart.emplace_back(clause.begin() + static_cast<std::ptrdiff_t>(start), clause.end());
  }
  return apart;
}

/// "sweetheart", "Marvin": one word that names nothing.
bool Utterance::isAddress(const Clause& clause) const {
  return clause.size() == 1 && !isGrammarWord(clause.front()) && !changesMeaning(clause.front()) && !index_.words().knows(clause.front());
}

/// Of the speaker, and after the question of nothing in the home.
bool Utterance::isIdleRemark(const Clause& clause, bool before_question) const {
  const auto matters = [&](const std::string& word) {
    return changesMeaning(word) || (!isGrammarWord(word) && index_.words().knows(word));
  };
  const bool about_it = !before_question && clause.size() > 2 && isOneOf(clause[0], {"it", "this", "that"}) && !isGrammarWord(clause[1]);
  if (about_it) {  // "it smells"
    return std::none_of(clause.begin(), clause.end(), matters);
  }
  return isOfSpeaker(clause) && (before_question || std::none_of(clause.begin(), clause.end(), matters));
}

/// The one thing that the clauses speak of; empty: none, or several.
std::vector<std::string> Utterance::antecedent(std::span<const Clause> clauses) const {
  std::vector<std::string> thing;
  const auto names = [&](const std::string& word) { return !isGrammarWord(word) && index_.words().knows(word); };
  for (const Clause& clause : clauses) {
    for (std::size_t i = 0; i < clause.size();) {
      std::size_t end = i;
      while (end < clause.size() && names(clause[end])) {
        ++end;
      }
      if (end == i) {
        ++i;
        continue;
      }
      std::size_t start = i;
      while (start > 0 && isFiller(clause[start - 1])) {
        --start;
      }
      const bool is_place = start > 0 && clause[start - 1] != "off" && findRelationWords(Words(clause).subspan(start - 1)).has_value();
      if (!is_place && !thing.empty()) {
        return {};
      }
      if (!is_place) {
        thing.assign(clause.begin() + static_cast<std::ptrdiff_t>(i), clause.begin() + static_cast<std::ptrdiff_t>(end));
      }
      i = end;
    }
  }
  return thing;
}

std::vector<Hearing> Utterance::asClauses() const {
  const std::vector<Clause> clauses = remarksApart();
  std::vector<std::string> addressed;
  std::vector<std::size_t> asking;
  for (std::size_t i = 0; i < clauses.size(); ++i) {
    if (isAddress(clauses[i])) {
      addressed.push_back(clauses[i].front());
    } else if (!isIdleRemark(clauses[i], asking.empty())) {
      asking.push_back(i);
    }
  }
  if (asking.empty()) {  // "I need my passport, Marvin"
    const auto last = std::find_if(clauses.rbegin(), clauses.rend(), isOfSpeaker);
    return last == clauses.rend() ? std::vector<Hearing>() : std::vector<Hearing>{{parse(*last), addressed}};
  }
  const std::size_t at = asking.back();
  const bool refers = hasPronoun(clauses[at]) && at > 0;
  const bool only_one = asking.size() == 1 || (asking.size() == 2 && refers && asking.front() + 1 == at);
  if (!only_one || clauses.size() == 1) {
    return {};
  }
  if (!refers) {
    return {{parse(clauses[at]), addressed}};
  }
  const std::vector<std::string> thing = antecedent(std::span(clauses).first(at));
  return thing.empty() ? std::vector<Hearing>() : std::vector<Hearing>{{parse(spelledOut(clauses[at], thing)), addressed}};
}

}  // namespace oikos::semantic
