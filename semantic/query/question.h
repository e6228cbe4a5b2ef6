// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::semantic {

enum class QuestionKind {
  kWhere,      ///< where is X
  kContents,   ///< what is on Y; which X are on Y
  kCount,      ///< how many X are on Y
  kIsThere,    ///< is there an X on Y; is X on Y
  kIsOpen,     ///< is X open
  kWhichOpen,  ///< which X are open
  kHowFar,     ///< how far is X open
  kSetting,    ///< what is X set to
};

struct PlaceWords {
  Relation relation = Relation::kIn;
  std::vector<std::string> words;
};

/// A question taken apart; what its words mean in a home is found out later.
struct Question {
  QuestionKind kind = QuestionKind::kWhere;
  std::vector<std::string> thing;  ///< empty: anything
  std::optional<PlaceWords> place;
  bool open = true;  ///< of kIsOpen and kWhichOpen: asked for open ones, or for closed ones
};

struct ParsedQuestion {
  std::optional<Question> question;
  std::string not_understood;  ///< the word at which it ended, where there is no question
};

/// Controlled English: a kind of question, a thing with its attributes, a place. Articles, case and punctuation do not matter.
[[nodiscard]] ParsedQuestion parseQuestion(std::string_view sentence);

}  // namespace oikos::semantic
