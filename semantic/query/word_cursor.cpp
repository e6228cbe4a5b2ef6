// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/word_cursor.h"

#include <algorithm>

namespace oikos::semantic {

bool isOneOf(std::string_view word, WordList list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool isSpeaker(std::string_view word) {
  return isOneOf(word, {"i", "you", "we", "one", "he", "she", "they", "it", "robot", "anyone", "anybody", "someone", "somebody", "people"});
}

bool isSeeing(std::string_view word) {
  return isOneOf(
      word, {"see", "saw", "seen", "notice", "noticed", "find", "found", "spot", "spotted", "observe", "observed", "detect", "detected"});
}

bool WordCursor::startsWith(WordList sequence) const {
  return words_.size() >= sequence.size() && std::equal(sequence.begin(), sequence.end(), words_.begin());
}

bool WordCursor::take(WordList list) {
  return takeIf([&](const std::string& word) { return isOneOf(word, list); });
}

bool WordCursor::takeAll(WordList sequence) {
  if (!startsWith(sequence)) {
    return false;
  }
  drop(sequence.size());
  return true;
}

bool WordCursor::takeBack(WordList list) {
  if (words_.empty() || !isOneOf(words_.back(), list)) {
    return false;
  }
  dropBack();
  return true;
}

bool WordCursor::takeAllBack(WordList sequence) {
  if (words_.size() < sequence.size() ||
      !std::equal(sequence.begin(), sequence.end(), words_.end() - static_cast<std::ptrdiff_t>(sequence.size()))) {
    return false;
  }
  dropBack(sequence.size());
  return true;
}

bool WordCursor::takeSpeaker() {
  take({"the"});
  return takeIf(isSpeaker);
}

bool WordCursor::takeModal() {
  return take({"can", "could", "do", "does", "did", "should", "would", "must", "may", "shall", "will", "to"});
}

std::size_t WordCursor::find(WordList list) const {
  return static_cast<std::size_t>(std::find_if(words_.begin(), words_.end(), [&](const std::string& word) { return isOneOf(word, list); }) -
                                  words_.begin());
}

}  // namespace oikos::semantic
