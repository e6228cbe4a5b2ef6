// SPDX-License-Identifier: Apache-2.0
// What people say around a question.
#include <algorithm>
#include <utility>

#include "semantic/query/home_words.h"
#include "semantic/query/spoken.h"
#include "semantic/query/thing_phrase.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

using Phrases = std::vector<std::vector<std::string>>;

void insertByLength(Phrases& phrases, std::vector<std::string> phrase) {
  const auto shorter = std::find_if(phrases.begin(), phrases.end(), [&](const auto& known) { return known.size() < phrase.size(); });
  phrases.insert(shorter, std::move(phrase));
}

/// "on the right" is no place to leave "right" out.
bool wantsMore(const std::string& word) {
  return word == "the" || word == "a" || word == "an" || word == "my" || word == "your" || word == "our" || word == "to" || word == "is";
}

}  // namespace

void HomeWords::addSurplus(const std::string& phrase) {
  const std::vector<std::string> words = spokenOut(wordsOf(phrase));
  if (!words.empty()) {
    insertByLength(surplus_by_first_[words.front()], words);
    insertByLength(surplus_by_last_[words.back()], words);
  }
}

/// The words of the longest such phrase that stands there; a single word that names something in the home is none.
std::size_t HomeWords::surplusAtFront(std::span<const std::string> words) const {
  const auto known = surplus_by_first_.find(words.front());
  if (known == surplus_by_first_.end()) {
    return 0;
  }
  for (const std::vector<std::string>& phrase : known->second) {
    const bool fits = phrase.size() <= words.size() && std::equal(phrase.begin(), phrase.end(), words.begin());
    if (fits && (phrase.size() > 1 || !knows(phrase.front()))) {
      return phrase.size();
    }
  }
  return 0;
}

std::size_t HomeWords::surplusAtBack(std::span<const std::string> words) const {
  const auto known = surplus_by_last_.find(words.back());
  if (known == surplus_by_last_.end()) {
    return 0;
  }
  for (const std::vector<std::string>& phrase : known->second) {
    const bool fits = phrase.size() < words.size() && std::equal(phrase.rbegin(), phrase.rend(), words.rbegin());
    if (fits && !wantsMore(words[words.size() - phrase.size() - 1]) && (phrase.size() > 1 || !knows(phrase.front()))) {
      return phrase.size();
    }
  }
  return 0;
}

bool HomeWords::isSurplus(std::span<const std::string> words) const {
  const auto known = words.empty() ? surplus_by_first_.end() : surplus_by_first_.find(words.front());
  return known != surplus_by_first_.end() && std::any_of(known->second.begin(), known->second.end(), [&](const auto& phrase) {
           return std::equal(phrase.begin(), phrase.end(), words.begin(), words.end());
         });
}

std::span<const std::string> HomeWords::withoutSurplus(std::span<const std::string> words) const {
  while (!words.empty()) {
    if (const std::size_t front = surplusAtFront(words); front > 0) {
      words = words.subspan(front);
    } else if (const std::size_t back = surplusAtBack(words); back > 0) {
      words = words.first(words.size() - back);
    } else {
      break;
    }
  }
  return words;
}

}  // namespace oikos::semantic
