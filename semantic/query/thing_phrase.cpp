// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/thing_phrase.h"

#include <algorithm>
#include <string_view>

#include "semantic/query/grammar_words.h"
#include "semantic/query/phrase_words.h"
#include "semantic/query/word_cursor.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

constexpr int kDeepest = 12;  // nested phrases: "the cup on the table in the room left of …"

/// "and", "or" before a further place: "on the sofa or on the table".
bool joinsPlaces(Words words) {
  return words.size() > 2 && isOneOf(words.front(), {"and", "or"}) && findRelationWords(words.subspan(1));
}

class PhraseReader {
 public:
  explicit PhraseReader(Words words, int depth) : words_(words), depth_(depth) {}

  ThingPhrase read() {
    trim();
    say();
    while (!words_.empty() && step()) {
    }
    phrase_.words.insert(phrase_.words.begin(), attributes_.begin(), attributes_.end());
    return std::move(phrase_);
  }

 private:
  /// Articles in front of it, and what an "in it" at its end refers to is the thing itself.
  void trim() {
    while (!words_.empty() && words_.front() != "'s" && isFiller(words_.front()) && !isOneOf(words_.front(), {"that", "of"})) {
      words_ = words_.subspan(1);
    }
    while (words_.size() > 1 && words_.back() != "'s" && isIdleAtEnd(words_.back())) {
      words_ = words_.first(words_.size() - 1);
    }
    if (words_.size() > 2 && isOneOf(words_.back(), {"it", "them"}) && isOneOf(words_[words_.size() - 2], {"in", "on", "inside"})) {
      words_ = words_.first(words_.size() - 2);
    }
  }

  void say() {
    const auto first = std::find_if_not(words_.begin(), words_.end(), [](const std::string& word) {
      return isOneOf(word, {"all", "every", "each", "both"});
    });
    for (const std::string& word : Words(first, words_.end())) {
      phrase_.said += (phrase_.said.empty() || word == "'s" ? "" : " ") + word;
    }
  }

  /// Whether there may be more.
  bool step() {
    const std::string& word = words_.front();
    if (word == "'s") {
      return takeOwner();
    }
    if (depth_ < kDeepest && readRest()) {
      return false;
    }
    if (isOneOf(word, {"nearest", "closest"})) {
      return takeNearest();
    }
    if (const auto ordinal = ordinalOf(word); ordinal && !phrase_.ordinal && words_.size() > 1) {
      return takeOrdinal(*ordinal);
    }
    takeWord(word);
    words_ = words_.subspan(1);
    return true;
  }

  void takeWord(const std::string& word) {
    const bool names_side = isOneOf(word, {"left", "right"});
    if (const auto open = opennessOf(word); open && (clause_ || anything_ || words_.size() > 1 || hasNoun())) {
      phrase_.open = open;
    } else if (isLinkVerb(word) && (words_.size() > 1 || isBe(word) || word == "it") &&
               !(names_side && !clause_ && phrase_.words.empty())) {
      clause_ = clause_ || !isOneOf(word, {"'s"});
    } else if (word == "for" && hasNoun() && words_.size() > 1) {
      clause_ = true;  // "the remote for the television"
    } else if (word == "furniture") {
      phrase_.furniture = true;
    } else if (isAnything(word)) {
      anything_ = true;
      phrase_.every = phrase_.every || isOneOf(word, {"all", "every", "each", "everything"});
    } else if (isNumberOfThem()) {
      phrase_.counted = true;
    } else if (!isFiller(word)) {
      (clause_ ? attributes_ : phrase_.words).push_back(word);
    }
  }

  /// "the two blue cups".
  [[nodiscard]] bool isNumberOfThem() const {
    return phrase_.words.empty() && !clause_ && words_.size() > 1 && isNumberWord(words_.front()) &&
           std::any_of(words_.begin() + 1, words_.end(), [](const std::string& word) { return singularOf(word) != word; });
  }

  [[nodiscard]] bool isSideAtEnd() const {
    return words_.size() <= 3 && words_.size() >= 2 && isOneOf(words_.front(), {"on", "at", "to"}) &&
           isOneOf(words_.back(), {"left", "right"});
  }
  [[nodiscard]] bool hasNoun() const {
    return !phrase_.words.empty() || phrase_.ordinal || phrase_.nearest || phrase_.furniture || !phrase_.whole.empty();
  }

  /// A place, a whole, a second thing: all that follows belongs to it.
  bool readRest() {
    const auto nested = [&](std::size_t skipped) { return PhraseReader(words_.subspan(skipped), depth_ + 1).read(); };
    if (isSideAtEnd()) {  // "the door on the left"
      phrase_.words.insert(phrase_.words.begin(), words_.back());
      return true;
    }
    if (auto place = readPlace()) {
      phrase_.places.push_back(std::move(*place));
      return true;
    }
    if (words_.front() == "of" && hasNoun() && words_.size() > 1) {
      phrase_.whole.push_back(nested(1));
      return true;
    }
    if (isOneOf(words_.front(), {"and", "or"}) && hasNoun() && words_.size() > 1) {
      phrase_.either = words_.front() == "or";
      phrase_.others.push_back(nested(1));
      if (phrase_.places.empty()) {  // "the cup and the bowl on the table"
        phrase_.places = phrase_.others.back().places;
      }
      return true;
    }
    return false;
  }

  /// "in the kitchen", "not on the table", "on the sofa or on the table": up to the end.
  std::optional<PlacePhrase> readPlace() {
    const std::size_t negations = words_.front() == "not" ? 1 : 0;
    const auto relation = findRelationWords(words_.subspan(negations));
    const std::size_t first = negations + (relation ? relation->count : 0);
    if (!relation || first >= words_.size()) {
      return std::nullopt;
    }
    std::size_t end = first + 1;
    while (end < words_.size() && !joinsPlaces(words_.subspan(end))) {
      ++end;
    }
    PlacePhrase place{relation->relation, PhraseReader(words_.subspan(first, end - first), depth_ + 1).read(), negations > 0, {}};
    if (end < words_.size()) {
      ThingPhrase further = PhraseReader(words_.subspan(end + 1), depth_ + 1).read();
      place.or_at = std::move(further.places);
    }
    return place;
  }

  /// "the cupboard's right door": what was read so far is the whole.
  bool takeOwner() {
    words_ = words_.subspan(1);
    if (hasNoun() && !words_.empty()) {
      ThingPhrase whole = std::move(phrase_);
      phrase_ = ThingPhrase{};
      phrase_.said = whole.said;
      whole.said.clear();
      for (const std::string& word : whole.words) {
        whole.said += (whole.said.empty() ? "" : " ") + word;
      }
      phrase_.whole.push_back(std::move(whole));
    }
    return true;
  }

  bool takeNearest() {
    const bool of_a_noun = hasNoun() || anything_;
    phrase_.nearest = true;
    words_ = words_.subspan(1);
    while (words_.size() > 1 && isOneOf(words_.front(), {"one", "ones", "thing"})) {
      words_ = words_.subspan(1);
    }
    const bool says_to = std::find(words_.begin(), words_.end(), "to") != words_.end();
    if (of_a_noun && !says_to && !words_.empty()) {  // "the lamp nearest the bed"
      phrase_.nearest_to.push_back(PhraseReader(words_, depth_ + 1).read());
      return false;
    }
    if (words_.size() > 1 && words_.front() == "to") {
      phrase_.nearest_to.push_back(PhraseReader(words_.subspan(1), depth_ + 1).read());
      return false;
    }
    // "the nearest chair to the desk"
    const auto to = std::find(words_.begin(), words_.end(), "to");
    if (to != words_.end() && to + 1 != words_.end() && depth_ < kDeepest && !findRelationWords(Words(to, words_.end()))) {
      phrase_.nearest_to.push_back(PhraseReader(Words(to + 1, words_.end()), depth_ + 1).read());
      words_ = Words(words_.begin(), to);
    }
    return true;
  }

  bool takeOrdinal(Ordinal ordinal) {
    words_ = words_.subspan(1);
    const auto from = std::find(words_.begin(), words_.end(), "from");
    const auto side = from == words_.end() ? words_.end() : std::find_if(from, words_.end(), [](const std::string& w) {
      return isOneOf(w, {"bottom", "top"});
    });
    if (side != words_.end() && side - from <= 2) {
      ordinal.from_bottom = *side == "bottom";
      ordinal.word = ordinal.from_bottom ? "" : ordinal.word;
      rest_.assign(words_.begin(), from);
      rest_.insert(rest_.end(), side + 1, words_.end());
      words_ = rest_;
    }
    phrase_.ordinal = ordinal;
    return true;
  }

  Words words_;
  int depth_;
  ThingPhrase phrase_;
  std::vector<std::string> attributes_;  ///< of a clause: "that is red"
  std::vector<std::string> rest_;
  bool clause_ = false;
  bool anything_ = false;  ///< "things", "something"
};

}  // namespace

ThingPhrase readThingPhrase(Words words) {
  return PhraseReader(words, 0).read();
}

}  // namespace oikos::semantic
