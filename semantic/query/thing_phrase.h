// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "semantic/query/question.h"

namespace oikos::semantic {

using Words = std::span<const std::string>;

/// Words that begin a place, and how many they are.
struct RelationWords {
  PlaceRelation relation = PlaceRelation::kIn;
  std::size_t count = 0;
};
/// At the front of the words: "on top of", "next to", "in"; nothing: another word stands there.
[[nodiscard]] std::optional<RelationWords> findRelationWords(Words words);

/// true: open, false: closed.
[[nodiscard]] std::optional<bool> opennessOf(const std::string& word);
[[nodiscard]] bool isBe(const std::string& word);

/// Reads all words as one noun with everything that says which is meant. Never fails: what is no grammar is a name.
[[nodiscard]] ThingPhrase readThingPhrase(Words words);

}  // namespace oikos::semantic
