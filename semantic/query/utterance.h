// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semantic/query/home_index.h"
#include "semantic/query/question.h"

namespace oikos::semantic {

/// One way to understand an utterance.
struct Hearing {
  ParsedQuestion parsed;
  std::vector<std::string> passed_over;  ///< words that mean nothing and stood alone between commas
};

/// What someone said: a question among courtesies and remarks. The index must outlive it.
class Utterance {
 public:
  Utterance(const HomeIndex& index, std::string_view text);

  /// Of all clauses; at most kMostWords and a few.
  [[nodiscard]] std::size_t words() const { return words_; }
  /// All of it as one question, without surplus words and tags.
  [[nodiscard]] Hearing asOne() const;
  /// The clause that asks, where the others are remarks: "I lost my keys. Do you know where they are?" None: no clause does, or another one
  /// may change what it asks.
  [[nodiscard]] std::vector<Hearing> asClauses() const;

 private:
  using Clause = std::vector<std::string>;
  [[nodiscard]] std::vector<Clause> remarksApart() const;
  [[nodiscard]] bool isAddress(const Clause& clause) const;
  [[nodiscard]] bool isIdleRemark(const Clause& clause, bool before_question) const;
  [[nodiscard]] std::vector<std::string> antecedent(std::span<const Clause> clauses) const;
  [[nodiscard]] ParsedQuestion parse(const Clause& clause) const;

  const HomeIndex& index_;
  std::vector<Clause> clauses_;  ///< without surplus words; none is empty
  bool tagged_ = false;
  std::size_t words_ = 0;
  std::string first_word_;
};

}  // namespace oikos::semantic
