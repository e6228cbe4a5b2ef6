// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "semantic/query/found_thing.h"
#include "semantic/query/home_index.h"

namespace oikos::semantic {

enum class AnswerStatus { kAnswered, kNothingFits, kUnknownWord, kNotUnderstood };
constexpr auto enumTable(AnswerStatus) {
  return std::to_array<base::EnumName<AnswerStatus>>({{AnswerStatus::kAnswered, "answered"},
                                                      {AnswerStatus::kNothingFits, "nothing_fits"},
                                                      {AnswerStatus::kUnknownWord, "unknown_word"},
                                                      {AnswerStatus::kNotUnderstood, "not_understood"}});
}

struct Answer {
  AnswerStatus status = AnswerStatus::kNotUnderstood;
  std::string sentence;
  std::vector<FoundThing> found;  ///< the first 20
  std::size_t total = 0;          ///< of all that fit
  std::vector<std::string> corrected;
};

/// Answers one question from the home as it stands. Never throws on any text. Thread-safe.
[[nodiscard]] Answer answerQuestion(const HomeIndex& index, std::string_view question);

/// {"status", "sentence", "total", "found": […], "corrected"}; metres and degrees.
[[nodiscard]] std::string toJson(const Answer& answer);

}  // namespace oikos::semantic
