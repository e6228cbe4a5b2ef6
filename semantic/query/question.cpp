// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>

#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

using Words = std::span<const std::string>;

bool isOneOf(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool isBe(const std::string& word) {
  return isOneOf(word, {"is", "are", "was", "were"});
}

std::optional<Relation> relationOf(const std::string& word) {
  if (isOneOf(word, {"on", "upon", "onto"})) {
    return Relation::kOn;
  }
  if (isOneOf(word, {"in", "inside", "into", "within", "at"})) {
    return Relation::kIn;
  }
  if (isOneOf(word, {"under", "below", "beneath", "underneath"})) {
    return Relation::kUnder;
  }
  return std::nullopt;
}

/// true: open, false: closed.
std::optional<bool> opennessOf(const std::string& word) {
  if (isOneOf(word, {"open", "opened", "ajar"})) {
    return true;
  }
  if (isOneOf(word, {"closed", "shut", "close"})) {
    return false;
  }
  return std::nullopt;
}

/// Reads words from the front.
class Parser {
 public:
  explicit Parser(Words words) : words_(words) {}

  ParsedQuestion parse() {
    skipPoliteness();
    Question question;
    const bool understood = read(question);
    if (understood && (!question.thing.empty() || question.place)) {
      return {question, {}};
    }
    return {std::nullopt, words_.empty() ? "" : words_.front()};
  }

 private:
  bool take(std::initializer_list<std::string_view> list) {
    if (words_.empty() || !isOneOf(words_.front(), list)) {
      return false;
    }
    words_ = words_.subspan(1);
    return true;
  }
  bool takeAll(std::initializer_list<std::string_view> sequence) {
    if (words_.size() < sequence.size() || !std::equal(sequence.begin(), sequence.end(), words_.begin())) {
      return false;
    }
    words_ = words_.subspan(sequence.size());
    return true;
  }
  bool takeBe() { return take({"is", "are", "was", "were"}); }

  void skipPoliteness() {
    while (take({"please", "hey", "hello", "oikos", "so", "and"}) || takeAll({"tell", "me"}) || takeAll({"can", "you"}) ||
           takeAll({"could", "you"}) || takeAll({"do", "you", "know"})) {
    }
  }

  bool read(Question& question) {
    if (take({"where"})) {
      return readWhere(question);
    }
    if (take({"find", "locate"})) {
      return readThing(question, QuestionKind::kWhere);
    }
    if (takeAll({"how", "many"})) {
      return readThing(question, QuestionKind::kCount);
    }
    if (takeAll({"how", "far"}) || takeAll({"how", "wide"})) {
      return readHowFar(question);
    }
    if (take({"what", "which"})) {
      return readWhat(question);
    }
    return takeBe() && readIs(question);
  }

  /// "where is X", "where can I find X", "where the X is", "where did I leave X".
  bool readWhere(Question& question) {
    if (!takeBe() && !takeAll({"can", "i", "find"}) && !takeAll({"do", "i", "find"}) && !takeAll({"did", "i", "leave"}) &&
        !takeAll({"did", "i", "put"}) && !words_.empty() && isBe(words_.back())) {
      words_ = words_.first(words_.size() - 1);
    }
    return readThing(question, QuestionKind::kWhere);
  }

  bool readHowFar(Question& question) {
    takeBe();
    if (!words_.empty() && opennessOf(words_.front())) {
      words_ = words_.subspan(1);  // "how far open is X"
      takeBe();
    }
    if (!words_.empty() && opennessOf(words_.back())) {
      words_ = words_.first(words_.size() - 1);
    }
    return readThing(question, QuestionKind::kHowFar);
  }

  /// After "what" or "which".
  bool readWhat(Question& question) {
    if (words_.size() > 2 && isOneOf(words_.back(), {"to", "at"}) && words_[words_.size() - 2] == "set") {
      takeBe();
      words_ = words_.first(words_.size() - 2);
      return readThing(question, QuestionKind::kSetting);
    }
    const auto be = std::find_if(words_.begin(), words_.end(), isBe);
    if (be == words_.end()) {
      return false;
    }
    question.thing.assign(words_.begin(), be);
    words_ = words_.subspan(static_cast<std::size_t>(be - words_.begin()) + 1);
    take({"there"});
    if (words_.size() == 1 && opennessOf(words_.front())) {
      question.kind = QuestionKind::kWhichOpen;
      question.open = *opennessOf(words_.front());
      return !question.thing.empty();
    }
    question.kind = QuestionKind::kContents;
    return readPlace(question);
  }

  /// After "is" or "are".
  bool readIs(Question& question) {
    if (take({"there"})) {
      return readThing(question, QuestionKind::kIsThere);
    }
    if (!words_.empty() && opennessOf(words_.back())) {
      question.open = *opennessOf(words_.back());
      words_ = words_.first(words_.size() - 1);
      return readThing(question, QuestionKind::kIsOpen);
    }
    return readThing(question, QuestionKind::kIsThere) && question.place.has_value();
  }

  /// "X", "X on Y", "X are there on Y".
  bool readThing(Question& question, QuestionKind kind) {
    question.kind = kind;
    const auto isLink = [](const std::string& word) { return relationOf(word).has_value(); };
    const auto link = std::find_if(words_.rbegin(), words_.rend(), isLink);
    Words thing = words_;
    if (link != words_.rend() && link != words_.rbegin()) {
      const auto position = static_cast<std::size_t>(words_.rend() - link) - 1;
      thing = words_.first(position);
      words_ = words_.subspan(position);
      if (!readPlace(question)) {
        return false;
      }
    }
    while (!thing.empty() && (isBe(thing.back()) || isOneOf(thing.back(), {"there", "now"}))) {
      thing = thing.first(thing.size() - 1);
    }
    question.thing.assign(thing.begin(), thing.end());
    std::erase_if(question.thing, [](const std::string& word) { return isFiller(word); });
    return true;
  }

  bool readPlace(Question& question) {
    take({"standing", "lying", "kept"});
    if (words_.size() < 2 || !relationOf(words_.front())) {
      return false;
    }
    question.place = PlaceWords{*relationOf(words_.front()), {words_.begin() + 1, words_.end()}};
    std::erase_if(question.place->words, [](const std::string& word) { return isFiller(word); });
    return !question.place->words.empty();
  }

  Words words_;
};

}  // namespace

ParsedQuestion parseQuestion(std::string_view sentence) {
  const std::vector<std::string> words = wordsOf(sentence);
  return Parser(words).parse();
}

}  // namespace oikos::semantic
