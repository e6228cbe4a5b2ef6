// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace oikos::base {

/// Levenshtein distance: insertions, deletions and replacements that turn `a` into `b`.
[[nodiscard]] int editDistance(std::string_view a, std::string_view b);

/// The candidate with the least edit distance to `name`, the first of equals; empty if there are no candidates.
[[nodiscard]] std::string nearestName(std::string_view name, std::span<const std::string> candidates);

/// "; did you mean 'NEAREST'?" if a candidate is near enough to be a slip, else "; known: A, B, C". Empty without candidates.
[[nodiscard]] std::string didYouMean(std::string_view name, std::span<const std::string> candidates);

}  // namespace oikos::base
