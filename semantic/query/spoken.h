// SPDX-License-Identifier: Apache-2.0
// From the way people speak to the way questions are written.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oikos::semantic {

/// Short forms in full: "whered i" is "where did i", "isnt" is "is not", "the cup 's on" is "the cup is on". Of words as wordsOf() gives
/// them.
[[nodiscard]] std::vector<std::string> spokenOut(std::vector<std::string> words);

/// The clauses of a text, parted by commas, full stops and dashes; times ("8:30") stay whole. None is empty.
[[nodiscard]] std::vector<std::string_view> clausesOf(std::string_view text);

/// Whether the words are a tag and nothing else: "is it", "will you", "are not they".
[[nodiscard]] bool isTag(std::span<const std::string> words);
/// The length of the tag at the end of a sentence that says something: "the phone is not on the sofa is it"; 0: none.
[[nodiscard]] std::size_t tagAtBack(std::span<const std::string> words);

/// A question whether something is so, asked with a doubt, asks the same without it: "is not the sugar on the table"; with `tagged` also
/// "the phone is not on the sofa".
void dropDoubt(std::vector<std::string>& words, bool tagged);

}  // namespace oikos::semantic
