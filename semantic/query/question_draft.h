// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "semantic/query/question.h"
#include "semantic/query/word_cursor.h"

namespace oikos::semantic {

/// A question that is being read: the words that are left, and what those before them said.
struct QuestionDraft {
  WordCursor words;
  Question question = {};
  std::optional<Question> otherwise = {};
  std::vector<std::string> edited = {};  ///< where `words` are no stretch of the sentence any more: they are here
  bool is_statement = false;

  /// All words that are left say which thing is meant. false: there are none.
  bool finish(QuestionKind kind);
  /// finish() of a question after changes by this verb: "opened" asks after what led to the state "open", "moved" after any.
  bool finishChange(const std::string& verb);
  /// The question asks for what `thing` lies at or is: "on the table", "open", "nearest to the bed", "red".
  bool finishPredicate(ThingPhrase thing, WordCursor predicate);
};

/// What a state is called in the answer's code: "open", "closed", or the word itself.
[[nodiscard]] std::string stateNamed(const std::string& word);
[[nodiscard]] bool isStateWord(const std::string& word);
/// "closed" of "open"; empty: what is not so may be much else.
[[nodiscard]] std::string oppositeOf(const std::string& state);
/// "any door", "a door", "something": one of them will do.
[[nodiscard]] bool saysAny(Words thing);
/// "still", "just": changes nothing before a state or a place.
[[nodiscard]] bool takeAdverbs(WordCursor& words);
[[nodiscard]] bool takeAdverbsBack(WordCursor& words);
/// Takes a state at the end with what belongs to it: "left open", "not turned off", and says which it is; empty: none stands there.
[[nodiscard]] std::string takeStateBack(WordCursor& words);
/// Where things are that `whole` has: in it, a part of it or on it.
[[nodiscard]] PlacePhrase having(ThingPhrase whole);
/// The place that all the nouns are at.
void addPlaces(ThingPhrase& thing, const std::vector<PlacePhrase>& places);

}  // namespace oikos::semantic
