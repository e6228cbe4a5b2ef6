// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/words.h"

#include <algorithm>
#include <array>

namespace oikos::semantic {

namespace {

constexpr std::size_t kMaxWords = 64;

bool isWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

void replaceEnding(std::string& word, std::size_t length, std::string_view ending) {
  word.replace(word.size() - length, length, ending);
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view sentence) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (word == "s" && !words.empty() && (words.back() == "what" || words.back() == "where" || words.back() == "there")) {
      word = "is";
    }
    if (!word.empty() && word != "s" && words.size() < kMaxWords) {
      words.push_back(word);
    }
    word.clear();
  };
  for (const char c : sentence) {
    const char small = lower(c);
    if (isWordCharacter(small)) {
      word += small;
    } else {
      finish();
    }
  }
  finish();
  return words;
}

std::string singularOf(const std::string& word) {
  std::string singular = word;
  if (word.size() < 4 || !word.ends_with('s') || word.ends_with("ss") || word.ends_with("us")) {
    return singular;
  }
  if (word.ends_with("ies")) {
    replaceEnding(singular, 3, "y");
  } else if (word.ends_with("knives")) {
    replaceEnding(singular, 3, "fe");
  } else if (word.ends_with("lves") || word.ends_with("aves")) {
    replaceEnding(singular, 3, "f");
  } else if (word.ends_with("ses") || word.ends_with("xes") || word.ends_with("zes") || word.ends_with("ches") || word.ends_with("shes")) {
    replaceEnding(singular, 2, "");
  } else {
    singular.pop_back();
  }
  return singular;
}

bool isFiller(std::string_view word) {
  constexpr std::array<std::string_view, 14> fillers{"the", "a",    "an",  "my",     "our", "your", "his",
                                                     "her", "some", "any", "please", "of",  "that", "those"};
  return std::find(fillers.begin(), fillers.end(), word) != fillers.end();
}

}  // namespace oikos::semantic
