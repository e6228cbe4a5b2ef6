// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/spoken.h"

#include <algorithm>
#include <array>
#include <utility>

#include "semantic/query/grammar_words.h"
#include "semantic/query/thing_phrase.h"
#include "semantic/query/word_cursor.h"

namespace oikos::semantic {

namespace {

struct ShortForm {
  std::string_view said;
  std::string_view first;
  std::string_view second;
};

constexpr auto kShortForms = std::to_array<ShortForm>({
    {"arent", "are", "not"},     {"couldnt", "could", "not"}, {"didnt", "did", "not"},       {"doesnt", "does", "not"},
    {"dont", "do", "not"},       {"gimme", "give", "me"},     {"gonna", "going", "to"},      {"gotta", "have", "to"},
    {"hadnt", "had", "not"},     {"hasnt", "has", "not"},     {"havent", "have", "not"},     {"heres", "here", "is"},
    {"hows", "how", "is"},       {"id", "i", "would"},        {"ill", "i", "will"},          {"im", "i", "am"},
    {"isnt", "is", "not"},       {"ive", "i", "have"},        {"shouldnt", "should", "not"}, {"thats", "that", "is"},
    {"theres", "there", "is"},   {"theyre", "they", "are"},   {"wanna", "want", "to"},       {"wasnt", "was", "not"},
    {"werent", "were", "not"},   {"weve", "we", "have"},      {"whatd", "what", "did"},      {"whatre", "what", "are"},
    {"whats", "what", "is"},     {"whatve", "what", "have"},  {"whens", "when", "is"},       {"whered", "where", "did"},
    {"wherere", "where", "are"}, {"wheres", "where", "is"},   {"whereve", "where", "have"},  {"whichs", "which", "is"},
    {"wont", "will", "not"},     {"wouldnt", "would", "not"}, {"youve", "you", "have"},
});
static_assert(std::is_sorted(kShortForms.begin(), kShortForms.end(), [](const auto& a, const auto& b) { return a.said < b.said; }));

const ShortForm* findShortForm(std::string_view word) {
  const auto found = std::lower_bound(kShortForms.begin(), kShortForms.end(), word, [](const auto& a, auto b) { return a.said < b; });
  return found != kShortForms.end() && found->said == word ? &*found : nullptr;
}

/// Of what is typed in a hurry; empty: it is none.
std::string_view fullWordOf(std::string_view word) {
  constexpr auto forms = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"r", "are"}, {"u", "you"}, {"ur", "your"}, {"pls", "please"}, {"plz", "please"}, {"thx", "thanks"}});
  const auto found = std::find_if(forms.begin(), forms.end(), [&](const auto& form) { return form.first == word; });
  return found == forms.end() ? std::string_view() : found->second;
}

bool isAuxiliary(std::string_view word) {
  return isOneOf(word, {"is", "are", "was", "were", "do", "does", "did", "have", "has", "can", "could", "will", "would", "should"});
}

/// "id" and "ill" are words of their own.
bool isMeantShort(const ShortForm& form, Words after) {
  return form.first != "i" || form.said == "im" || form.said == "ive" ||
         (!after.empty() && isOneOf(after.front(), {"like", "love", "prefer", "need", "have", "take", "be"}));
}

/// An owner's ending that is none: "the cup's on the table", "what room's the tub in".
bool standsForIs(Words after) {
  return !after.empty() && (isOneOf(after.front(), {"the", "a", "an", "my", "our", "your", "where", "not"}) || findRelationWords(after));
}

/// What parts clauses there, in bytes; 0: nothing.
std::size_t breakAt(std::string_view text, std::size_t i) {
  constexpr auto dashes = std::to_array<std::string_view>({" - ", "\xE2\x80\x94", "\xE2\x80\x93", "..."});
  for (const std::string_view dash : dashes) {
    if (text.substr(i, dash.size()) == dash) {
      return dash.size();
    }
  }
  const bool before_space = i + 1 == text.size() || text[i + 1] == ' ' || text[i + 1] == '\n';
  if (std::string_view(",.:").find(text[i]) != std::string_view::npos) {
    return before_space ? 1 : 0;
  }
  return std::string_view(";!?\n").find(text[i]) != std::string_view::npos ? 1 : 0;
}

}  // namespace

std::vector<std::string> spokenOut(std::vector<std::string> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (const auto full = fullWordOf(words[i]); !full.empty()) {
      words[i] = full;
    } else if (words[i] == "'s" && standsForIs(Words(words).subspan(i + 1))) {
      words[i] = "is";
    } else if (const ShortForm* form = findShortForm(words[i]); form != nullptr && isMeantShort(*form, Words(words).subspan(i + 1))) {
      words[i] = form->first;
      words.insert(words.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::string(form->second));
    }
  }
  return words;
}

std::vector<std::string_view> clausesOf(std::string_view text) {
  std::vector<std::string_view> clauses;
  std::size_t start = 0;
  const auto close = [&](std::size_t end) {
    if (text.substr(start, end - start).find_first_not_of(" \n\t\"'") != std::string_view::npos) {
      clauses.push_back(text.substr(start, end - start));
    }
  };
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = breakAt(text, i);
    if (length > 0) {
      close(i);
      start = i + length;
    }
    i += std::max<std::size_t>(length, 1);
  }
  close(text.size());
  return clauses;
}

bool isTag(Words words) {
  WordCursor cursor(words);
  return cursor.takeIf(isAuxiliary) &&
         (cursor.take({"not"}), cursor.take({"it", "they", "we", "you", "i", "he", "she", "there", "that"})) &&
         (cursor.take({"not"}), cursor.empty());
}

std::size_t tagAtBack(Words words) {
  for (const std::size_t length : {3U, 2U}) {
    if (words.size() < length + 3 || !isTag(words.last(length))) {
      continue;
    }
    const Words said = words.first(words.size() - length);
    const bool is_question = isAuxiliary(said.front()) || isOneOf(said.front(), {"where", "what", "which", "how", "when", "who"});
    if (!is_question && !isOneOf(said.back(), {"where", "what", "how", "when"}) && std::any_of(said.begin(), said.end(), isAuxiliary)) {
      return length;
    }
  }
  return 0;
}

void dropDoubt(std::vector<std::string>& words, bool tagged) {
  const auto first = words.begin();
  const bool forbids = words.size() > 2 && words[0] == "do" && !isSpeaker(words[2]);  // "do not bring me the cup"
  const bool asks = words.size() > 2 && words[1] == "not" && !forbids;
  const auto found = tagged ? std::find(first, words.end(), "not") : asks ? first + 1 : words.end();
  if (found != words.end() && found != first && isAuxiliary(*(found - 1))) {
    words.erase(found);
  }
}

}  // namespace oikos::semantic
