// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace oikos::semantic {

/// Words that name nothing and change nothing where they stand before a noun: articles, possessives, "please", "still".
[[nodiscard]] bool isFiller(std::string_view word);

/// Words that sentences are built of, states and relations among them ("open", "on", "know"): where the home does not call anything so,
/// they are no misspelt noun and no noun that the home lacks.
[[nodiscard]] bool isGrammarWord(std::string_view word);

/// "two", "2": how many there are, before a noun.
[[nodiscard]] bool isNumberWord(std::string_view word);

}  // namespace oikos::semantic
