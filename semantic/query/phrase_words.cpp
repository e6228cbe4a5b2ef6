// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/phrase_words.h"

#include <algorithm>
#include <array>

#include "semantic/query/grammar_words.h"
#include "semantic/query/word_cursor.h"

namespace oikos::semantic {

namespace {

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

}  // namespace

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

bool isAnything(std::string_view word) {
  return isOneOf(word, {"thing", "things", "object", "objects", "item", "items", "anything", "something", "everything", "stuff", "one",
                        "ones", "all", "every", "each", "piece", "pieces"});
}

bool isLinkVerb(std::string_view word) {
  return isOneOf(word, {"that",     "which",    "who",      "is",         "are",      "was",       "were",    "be",     "been",  "lying",
                        "standing", "sitting",  "kept",     "stored",     "located",  "placed",    "lies",    "stands", "sits",  "lie",
                        "stand",    "sit",      "with",     "containing", "contains", "contain",   "holding", "holds",  "has",   "have",
                        "having",   "full",     "made",     "colored",    "coloured", "belonging", "belongs", "owned",  "owns",  "called",
                        "named",    "labelled", "labeled",  "it",         "put",      "left",      "hanging", "hang",   "hangs", "resting",
                        "hidden",   "laid",     "situated", "positioned", "found",    "waiting",   "got"});
}

bool isIdleAtEnd(std::string_view word) {
  return (isFiller(word) && !isOneOf(word, {"other", "of"})) ||
         isOneOf(word, {"located", "placed", "situated", "kept", "stored", "lying", "standing", "hidden", "found"});
}

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

}  // namespace oikos::semantic
