// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/grammar_words.h"

#include <algorithm>
#include <array>

namespace oikos::semantic {

namespace {

template <std::size_t N>
constexpr bool isIn(const std::array<std::string_view, N>& sorted, std::string_view word) {
  return std::binary_search(sorted.begin(), sorted.end(), word);
}

constexpr auto kFillers = std::to_array<std::string_view>(
    {"'s",    "a",      "actually", "again",  "already",  "altogether", "an",       "any",    "anyway", "both",  "currently", "either",
     "else",  "entire", "even",     "ever",   "exactly",  "her",        "his",      "just",   "kindly", "maybe", "my",        "of",
     "other", "our",    "perhaps",  "please", "possibly", "properly",   "really",   "simply", "some",   "still", "that",      "the",
     "their", "there",  "these",    "this",   "those",    "though",     "together", "whole",  "yet",    "your"});

constexpr auto kGrammar = std::to_array<std::string_view>(
    {"a",          "about",      "actually",  "after",   "again",    "ago",     "all",       "along",    "already",   "also",
     "altogether", "am",         "an",        "and",     "any",      "anybody", "anyone",    "anything", "anyway",    "anywhere",
     "are",        "arent",      "as",        "asked",   "at",       "away",    "back",      "be",       "because",   "been",
     "before",     "being",      "better",    "between", "both",     "but",     "by",        "can",      "cannot",    "cant",
     "check",      "closed",     "closer",    "closest", "come",     "could",   "currently", "did",      "different", "do",
     "does",       "doing",      "done",      "down",    "either",   "else",    "empty",     "entire",   "even",      "ever",
     "every",      "everything", "exactly",   "except",  "farther",  "find",    "first",     "for",      "forget",    "forgot",
     "found",      "from",       "get",       "give",    "go",       "goes",    "going",     "gone",     "got",       "had",
     "half",       "has",        "have",      "having",  "he",       "hell",    "her",       "here",     "his",       "hold",
     "how",        "i",          "if",        "in",      "inside",   "instead", "into",      "is",       "it",        "its",
     "just",       "keep",       "kindly",    "know",    "last",     "leave",   "left",      "let",      "like",      "likes",
     "list",       "live",       "look",      "looking", "lost",     "lying",   "make",      "many",     "may",       "maybe",
     "me",         "mean",       "might",     "mine",    "more",     "most",    "move",      "moved",    "much",      "must",
     "my",         "name",       "near",      "nearest", "need",     "needs",   "neither",   "never",    "next",      "no",
     "nobody",     "none",       "nor",       "not",     "nothing",  "now",     "of",        "off",      "often",     "on",
     "once",       "one",        "ones",      "only",    "open",     "opened",  "opposite",  "or",       "other",     "ought",
     "our",        "out",        "outside",   "over",    "perhaps",  "place",   "please",    "possibly", "properly",  "put",
     "quite",      "rather",     "reach",     "really",  "right",    "round",   "same",      "say",      "says",      "see",
     "seen",       "she",        "should",    "show",    "shut",     "simply",  "since",     "so",       "some",      "somebody",
     "someone",    "something",  "somewhere", "stand",   "standing", "stands",  "still",     "switched", "take",      "taken",
     "tell",       "than",       "thank",     "that",    "the",      "their",   "then",      "there",    "these",     "they",
     "thing",      "things",     "think",     "this",    "those",    "though",  "through",   "till",     "time",      "to",
     "together",   "told",       "too",       "toward",  "turn",     "turned",  "under",     "unless",   "until",     "up",
     "us",         "usually",    "want",      "wants",   "was",      "way",     "we",        "well",     "went",      "were",
     "what",       "when",       "where",     "whether", "which",    "who",     "whole",     "whom",     "whose",     "why",
     "will",       "with",       "within",    "without", "wonder",   "wont",    "would",     "yes",      "yesterday", "yet",
     "you",        "your",       "yours"});

static_assert(std::is_sorted(kFillers.begin(), kFillers.end()) && std::is_sorted(kGrammar.begin(), kGrammar.end()));

}  // namespace

bool isFiller(std::string_view word) {
  return isIn(kFillers, word);
}

bool isGrammarWord(std::string_view word) {
  return isIn(kGrammar, word);
}

bool isNumberWord(std::string_view word) {
  constexpr auto names = std::to_array<std::string_view>({"two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"});
  const bool digits =
      !word.empty() && word.size() <= 2 && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits || std::find(names.begin(), names.end(), word) != names.end();
}

}  // namespace oikos::semantic
