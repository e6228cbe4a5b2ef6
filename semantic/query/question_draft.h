// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "semantic/query/question.h"
#include "semantic/query/word_cursor.h"

namespace oikos::semantic {

/// A question that is being read: the words that are left, and what those before them said.
struct QuestionDraft {
  WordCursor words;
  Question question = {};
  std::vector<std::string> edited = {};  ///< where `words` are no stretch of the sentence any more: they are here
  bool is_statement = false;

  /// All words that are left say which thing is meant. false: there are none.
  bool finish(QuestionKind kind);
  /// finish() of a question after changes by this verb: "opened" asks after what led to the state "open", "moved" after any.
  bool finishChange(const std::string& verb);
};

/// What a state is called in the answer's code: "open", "closed", or the word itself.
[[nodiscard]] std::string stateNamed(const std::string& word);
[[nodiscard]] bool isStateWord(const std::string& word);

}  // namespace oikos::semantic
