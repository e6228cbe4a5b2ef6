// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/words.h"

#include <algorithm>
#include <array>

namespace oikos::semantic {

namespace {

bool isWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// The length of the apostrophe there; 0: none.
std::size_t apostropheAt(std::string_view sentence, std::size_t i) {
  constexpr std::string_view typographic = "\xE2\x80\x99";
  if (sentence.substr(i, typographic.size()) == typographic) {
    return typographic.size();
  }
  return i < sentence.size() && sentence[i] == '\'' ? 1 : 0;
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// The colon of a time or the dash of a date, in a word of digits that began at `start`.
bool joinsDigits(std::string_view sentence, std::size_t start, std::size_t i) {
  return (sentence[i] == ':' || sentence[i] == '-') && i > start && i + 1 < sentence.size() && isDigit(sentence[start]) &&
         isDigit(sentence[i - 1]) && isDigit(sentence[i + 1]);
}

/// `ending` is what follows the apostrophe.
void addWithApostrophe(std::vector<std::string>& words, std::string word, std::string_view ending) {
  constexpr std::array<std::string_view, 10> before_is{"what", "where", "there", "that", "it", "who", "how", "here", "when", "which"};
  std::string after(ending);
  std::transform(after.begin(), after.end(), after.begin(), lower);
  const bool is_verb = std::find(before_is.begin(), before_is.end(), word) != before_is.end();
  if (after == "s" || after.empty()) {
    const bool owner = after == "s" || word.ends_with('s');
    words.push_back(std::move(word));
    if (owner) {
      words.emplace_back(is_verb ? "is" : "'s");
    }
  } else if (word == "we" && after == "re") {  // "were" is another word
    words.insert(words.end(), {"we", "are"});
  } else {
    words.push_back(word + after);
  }
}

void replaceEnding(std::string& word, std::size_t length, std::string_view ending) {
  word.replace(word.size() - length, length, ending);
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view sentence) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < sentence.size() && words.size() <= kMostWords;) {
    const std::size_t start = i;
    while (i < sentence.size() && (isWordCharacter(lower(sentence[i])) || joinsDigits(sentence, start, i))) {
      ++i;
    }
    if (i == start) {
      i += std::max<std::size_t>(apostropheAt(sentence, i), 1);
      continue;
    }
    std::string word(sentence.substr(start, i - start));
    std::transform(word.begin(), word.end(), word.begin(), lower);
    if (const std::size_t length = apostropheAt(sentence, i); length > 0) {
      i += length;
      std::size_t end = i;
      while (end < sentence.size() && isWordCharacter(lower(sentence[end]))) {
        ++end;
      }
      addWithApostrophe(words, std::move(word), sentence.substr(i, end - i));
      i = end;
    } else {
      words.push_back(std::move(word));
    }
  }
  return words;
}

bool isOneSlipAway(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty() || (a[0] != b[0] && (a.size() < 2 || b.size() < 2 || a[0] != b[1] || a[1] != b[0]))) {
    return false;
  }
  if (a.size() > b.size()) {
    std::swap(a, b);
  }
  if (b.size() - a.size() > 1) {
    return false;
  }
  const std::size_t start = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
  a.remove_prefix(start);
  b.remove_prefix(start);
  if (a.size() != b.size()) {
    return a == b.substr(1);
  }
  const bool swapped = a.size() >= 2 && a[0] == b[1] && a[1] == b[0] && a.substr(2) == b.substr(2);
  return a.empty() || a.substr(1) == b.substr(1) || swapped;
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

}  // namespace oikos::semantic
