// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oikos::semantic {

/// Lower-case words of a sentence: letters and digits, everything else parts them, but for times and dates ("8:00", "2026-03-10"). An
/// owner's ending is the word "'s" ("Anna's", "Jonas'"); "what's" is "what is", "don't" is "dont". At most `kMostWords` and one.
[[nodiscard]] std::vector<std::string> wordsOf(std::string_view sentence);
constexpr std::size_t kMostWords = 64;

/// The singular of an English noun by its ending ("dishes" is "dish", "knives" is "knife", "glasses" is "glass"); other words as they are.
[[nodiscard]] std::string singularOf(const std::string& word);

/// At most one letter added, left out, changed, or two neighbours swapped. Few mistype the first letter.
[[nodiscard]] bool isOneSlipAway(std::string_view a, std::string_view b);

}  // namespace oikos::semantic
