// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oikos::semantic {

/// Lower-case words of a sentence: letters and digits, everything else parts them; "what's" is "what is". At most 64.
[[nodiscard]] std::vector<std::string> wordsOf(std::string_view sentence);

/// The singular of an English noun by its ending ("dishes" is "dish", "knives" is "knife", "glasses" is "glass"); other words as they are.
[[nodiscard]] std::string singularOf(const std::string& word);

/// Words that name nothing: articles, possessives, "please".
[[nodiscard]] bool isFiller(std::string_view word);

}  // namespace oikos::semantic
