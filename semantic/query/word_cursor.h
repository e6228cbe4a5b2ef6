// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

using WordList = std::initializer_list<std::string_view>;

[[nodiscard]] bool isOneOf(std::string_view word, WordList list);
/// Who may ask or act: "I", "we", "anyone".
[[nodiscard]] bool isSpeaker(std::string_view word);
/// "see", "found": seeing in any form.
[[nodiscard]] bool isSeeing(std::string_view word);

/// Takes words from the front and from the back of what is left. The words must outlive it.
class WordCursor {
 public:
  explicit WordCursor(Words words) : words_(words) {}

  [[nodiscard]] bool empty() const { return words_.empty(); }
  [[nodiscard]] Words rest() const { return words_; }
  [[nodiscard]] const std::string& front() const { return words_.front(); }
  [[nodiscard]] const std::string& back() const { return words_.back(); }
  [[nodiscard]] bool startsWith(WordList sequence) const;
  void drop(std::size_t count = 1) { words_ = words_.subspan(count); }
  void dropBack(std::size_t count = 1) { words_ = words_.first(words_.size() - count); }

  // These take what they name, if it stands there, and say whether it did.
  bool take(WordList list);
  bool takeAll(WordList sequence);
  bool takeBack(WordList list);
  bool takeAllBack(WordList sequence);
  /// "the robot", "anyone".
  bool takeSpeaker();
  bool takeBe() { return takeIf(isBe); }
  bool takeModal();
  template <class Fits>
  bool takeIf(const Fits& fits) {
    if (words_.empty() || !fits(words_.front())) {
      return false;
    }
    drop();
    return true;
  }

  /// Where the first of these words stands; the number of words: nowhere.
  [[nodiscard]] std::size_t find(WordList list) const;

 private:
  Words words_;
};

}  // namespace oikos::semantic
