// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/thing_phrase.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

constexpr int kDeepest = 12;  // nested phrases: "the cup on the table in the room left of …"

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

struct RelationName {
  std::array<std::string_view, 5> words;
  PlaceRelation relation;
};

/// The longer ones first.
constexpr std::array<RelationName, 41> kRelationNames{{
    {{"to", "the", "left", "of"}, PlaceRelation::kLeftOf},
    {{"to", "the", "right", "of"}, PlaceRelation::kRightOf},
    {{"on", "the", "left", "side", "of"}, PlaceRelation::kLeftOf},
    {{"on", "the", "right", "side", "of"}, PlaceRelation::kRightOf},
    {{"on", "the", "left", "of"}, PlaceRelation::kLeftOf},
    {{"on", "the", "right", "of"}, PlaceRelation::kRightOf},
    {{"on", "the", "top", "of"}, PlaceRelation::kOn},
    {{"in", "the", "front", "of"}, PlaceRelation::kInFrontOf},
    {{"in", "front", "of"}, PlaceRelation::kInFrontOf},
    {{"on", "top", "of"}, PlaceRelation::kOn},
    {{"left", "of"}, PlaceRelation::kLeftOf},
    {{"right", "of"}, PlaceRelation::kRightOf},
    {{"out", "of"}, PlaceRelation::kFrom},
    {{"inside", "of"}, PlaceRelation::kIn},
    {{"next", "to"}, PlaceRelation::kNear},
    {{"close", "to"}, PlaceRelation::kNear},
    {{"near", "to"}, PlaceRelation::kNear},
    {{"on"}, PlaceRelation::kOn},
    {{"upon"}, PlaceRelation::kOn},
    {{"onto"}, PlaceRelation::kOn},
    {{"atop"}, PlaceRelation::kOn},
    {{"in"}, PlaceRelation::kIn},
    {{"inside"}, PlaceRelation::kIn},
    {{"into"}, PlaceRelation::kIn},
    {{"within"}, PlaceRelation::kIn},
    {{"under"}, PlaceRelation::kUnder},
    {{"below"}, PlaceRelation::kUnder},
    {{"beneath"}, PlaceRelation::kUnder},
    {{"underneath"}, PlaceRelation::kUnder},
    {{"at"}, PlaceRelation::kAt},
    {{"from"}, PlaceRelation::kFrom},
    {{"off"}, PlaceRelation::kFrom},
    {{"near"}, PlaceRelation::kNear},
    {{"beside"}, PlaceRelation::kNear},
    {{"by"}, PlaceRelation::kNear},
    {{"around"}, PlaceRelation::kNear},
    {{"behind"}, PlaceRelation::kBehind},
    {{"above"}, PlaceRelation::kAbove},
    {{"over"}, PlaceRelation::kAbove},
    {{"underneath", "of"}, PlaceRelation::kUnder},
    {{"beneath", "of"}, PlaceRelation::kUnder},
}};

/// "second" is 1; nothing: no such word.
std::optional<Ordinal> ordinalOf(const std::string& word) {
  constexpr std::array<std::string_view, 10> names{"first", "second",  "third",  "fourth", "fifth",
                                                   "sixth", "seventh", "eighth", "ninth",  "tenth"};
  constexpr std::array<std::string_view, 10> digits{"1st", "2nd", "3rd", "4th", "5th", "6th", "7th", "8th", "9th", "10th"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (word == names[i] || word == digits[i]) {
      return Ordinal{static_cast<int>(i), false, false, std::string(names[i])};
    }
  }
  if (isOneOf(word, {"top", "topmost", "upper", "uppermost", "highest"})) {
    return Ordinal{0, false, false, "top"};
  }
  if (isOneOf(word, {"bottom", "lower", "lowest", "bottommost"})) {
    return Ordinal{0, true, false, "bottom"};
  }
  return word == "middle" ? std::optional(Ordinal{0, false, true, "middle"}) : std::nullopt;
}

/// Names anything at all.
bool isAnything(std::string_view word) {
  return isOneOf(word, {"thing", "things", "object", "objects", "item", "items", "anything", "something", "everything", "stuff", "one",
                        "ones", "all", "nothing", "every", "each"});
}

/// Stands before a place or an attribute and says no more than that it comes.
bool isLinkVerb(std::string_view word) {
  return isOneOf(word, {"that",     "which",    "who",     "is",         "are",      "was",       "were",    "be",     "been", "lying",
                        "standing", "sitting",  "kept",    "stored",     "located",  "placed",    "lies",    "stands", "sits", "lie",
                        "stand",    "sit",      "with",    "containing", "contains", "contain",   "holding", "holds",  "has",  "have",
                        "having",   "full",     "made",    "colored",    "coloured", "belonging", "belongs", "owned",  "owns", "called",
                        "named",    "labelled", "labeled", "it",         "put",      "left"});
}

class PhraseReader {
 public:
  explicit PhraseReader(Words words, int depth) : words_(words), depth_(depth) {}

  ThingPhrase read() {
    trim();
    for (const std::string& word : words_) {
      phrase_.said += (phrase_.said.empty() || word == "'s" ? "" : " ") + word;
    }
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
    if (words_.size() > 2 && isOneOf(words_.back(), {"it", "them"}) && isOneOf(words_[words_.size() - 2], {"in", "on", "inside"})) {
      words_ = words_.first(words_.size() - 2);
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
    const bool names_side = isOneOf(word, {"left", "right"});
    if (const auto open = opennessOf(word); open && (clause_ || words_.size() > 1)) {
      phrase_.open = open;
    } else if (isLinkVerb(word) && (words_.size() > 1 || isBe(word) || word == "it") &&
               !(names_side && !clause_ && phrase_.words.empty())) {
      clause_ = clause_ || !isOneOf(word, {"'s"});
    } else if (isFiller(word) || isAnything(word)) {
      // says nothing
    } else {
      (clause_ ? attributes_ : phrase_.words).push_back(word);
    }
    words_ = words_.subspan(1);
    return true;
  }

  [[nodiscard]] bool isSideAtEnd() const {
    return words_.size() <= 3 && words_.size() >= 2 && isOneOf(words_.front(), {"on", "at", "to"}) &&
           isOneOf(words_.back(), {"left", "right"});
  }
  [[nodiscard]] bool hasNoun() const { return !phrase_.words.empty() || phrase_.ordinal || phrase_.nearest || !phrase_.whole.empty(); }

  /// A place, a whole, a second thing: all that follows belongs to it.
  bool readRest() {
    const auto nested = [&](std::size_t skipped) { return PhraseReader(words_.subspan(skipped), depth_ + 1).read(); };
    if (isSideAtEnd()) {  // "the door on the left"
      phrase_.words.insert(phrase_.words.begin(), words_.back());
      return true;
    }
    if (const auto relation = findRelationWords(words_); relation && relation->count < words_.size()) {
      phrase_.places.push_back({relation->relation, nested(relation->count)});
      return true;
    }
    if (words_.front() == "of" && hasNoun() && words_.size() > 1) {
      phrase_.whole.push_back(nested(1));
      return true;
    }
    if (isOneOf(words_.front(), {"and", "or"}) && hasNoun() && words_.size() > 1) {
      phrase_.others.push_back(nested(1));
      return true;
    }
    return false;
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
    phrase_.nearest = true;
    words_ = words_.subspan(1);
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
};

}  // namespace

bool isBe(const std::string& word) {
  return isOneOf(word, {"is", "are", "was", "were"});
}

std::optional<bool> opennessOf(const std::string& word) {
  if (isOneOf(word, {"open", "opened", "ajar"})) {
    return true;
  }
  if (isOneOf(word, {"closed", "shut"})) {
    return false;
  }
  return std::nullopt;
}

std::optional<RelationWords> findRelationWords(Words words) {
  for (const RelationName& name : kRelationNames) {
    const auto end = std::find(name.words.begin(), name.words.end(), std::string_view());
    const auto count = static_cast<std::size_t>(end - name.words.begin());
    if (words.size() >= count && std::equal(name.words.begin(), end, words.begin())) {
      return RelationWords{name.relation, count};
    }
  }
  return std::nullopt;
}

ThingPhrase readThingPhrase(Words words) {
  return PhraseReader(words, 0).read();
}

}  // namespace oikos::semantic
