// SPDX-License-Identifier: Apache-2.0
// What single words do in a phrase that says which thing is meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

/// "second" is one step from the top; nothing: no such word.
[[nodiscard]] std::optional<Ordinal> ordinalOf(const std::string& word);
/// Names anything at all.
[[nodiscard]] bool isAnything(std::string_view word);
/// Stands before a place or an attribute and says no more than that it comes.
[[nodiscard]] bool isLinkVerb(std::string_view word);
/// Says nothing at the end: "the cup still", "where is the cup located".
[[nodiscard]] bool isIdleAtEnd(std::string_view word);

}  // namespace oikos::semantic
