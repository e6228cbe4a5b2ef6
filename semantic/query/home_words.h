// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "semantic/model/vocabulary.h"
#include "semantic/query/thing.h"

namespace oikos::semantic {

/// One thing that all words fit; the less the rank, the more likely it was meant.
struct Match {
  std::uint32_t thing = 0;
  int rank = 0;  ///< 0: the last word is its type or its whole name; 1: by another word for its type; … 5: only its furniture fits
};

/// What was meant by some words, one after another.
struct Lookup {
  std::vector<Match> matches;          ///< by the number of the thing
  std::vector<std::string> unknown;    ///< words that mean nothing here; one that the vocabulary knows only fits nothing
  std::vector<std::string> corrected;  ///< "was -> taken for"

  /// The numbers of those of the best rank.
  [[nodiscard]] std::vector<std::uint32_t> best() const;
};

/// The words of a home: for each the list of things that it fits. They stay as long as nothing but states changes. Built up by one thread,
/// then constant and thread-safe.
class HomeWords {
 public:
  explicit HomeWords(const Vocabulary& vocabulary);
  /// Of the next number.
  void add(const Thing& thing);

  [[nodiscard]] Lookup find(const std::vector<std::string>& words) const;
  [[nodiscard]] std::optional<std::uint32_t> findNumber(std::string_view id) const;
  [[nodiscard]] std::size_t size() const { return numbers_.size(); }
  /// Names that have a word in them which sentences use for their own purposes ("chest of drawers") become one word with spaces.
  [[nodiscard]] std::vector<std::string> joinNames(const std::vector<std::string>& words) const;
  /// Known words that are at most two slips away, the nearest first; at most three.
  [[nodiscard]] std::vector<std::string> nearestWords(const std::string& word) const;
  /// Whether something is called so, or the vocabulary has it, without any correction.
  [[nodiscard]] bool knows(const std::string& word) const;
  /// Whether something is called so, not only has it as a property: "cup", but not "red".
  [[nodiscard]] bool isNoun(const std::string& word) const;
  /// Whether the vocabulary calls just these words surplus, even if one of them names something too.
  [[nodiscard]] bool isSurplus(std::span<const std::string> words) const;
  /// Takes what the vocabulary calls surplus off both ends: "could you tell me", "sweetheart". All of the words may go.
  [[nodiscard]] std::span<const std::string> withoutSurplus(std::span<const std::string> words) const;

 private:
  /// How a word fits a thing; the bits of a mark.
  enum Fit : std::uint8_t { kOwn = 1, kType = 2, kWhole = 4, kHead = 8, kNoun = 16 };
  struct Posting {
    std::uint32_t thing = 0;
    std::uint8_t fit = 0;
  };
  using Postings = std::vector<Posting>;
  /// Things that a word fits: by itself or its singular, or by what the vocabulary calls it.
  struct Sense {
    const Postings* things = nullptr;
    bool by_other_word = false;
  };
  /// One word of a question: everything that it may mean.
  using Meaning = std::vector<Sense>;
  struct Text {
    std::string_view text;
    bool is_type = false;
    bool is_own = true;  ///< not only its furniture's
    bool is_property = false;
    bool is_id = false;
  };
  struct StringHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
  };
  template <class Value>
  using Table = std::unordered_map<std::string, Value, StringHash, std::equal_to<>>;

  struct Phrase {
    std::string text;
    std::size_t first = 0;  ///< of the words
    std::size_t count = 1;
  };

  void addText(std::uint32_t number, const Text& text);
  void addPosting(const std::string& key, Posting posting);
  void addName(std::string_view text);
  /// The words as the longest phrases of the vocabulary, everything else one by one.
  [[nodiscard]] std::vector<Phrase> phrasesOf(const std::vector<std::string>& words) const;
  /// Of a phrase; `verbatim`: as it was written, where it is one word. Empty: the word means nothing here.
  [[nodiscard]] Meaning meaningOf(const std::string& phrase, const std::string& verbatim) const;
  [[nodiscard]] static std::size_t sizeOf(const Meaning& meaning);
  void addSurplus(const std::string& phrase);
  [[nodiscard]] std::size_t surplusAtFront(std::span<const std::string> words) const;
  [[nodiscard]] std::size_t surplusAtBack(std::span<const std::string> words) const;
  [[nodiscard]] std::string correctionOf(const std::string& word) const;
  [[nodiscard]] static std::optional<int> rankOf(const Meaning& meaning, std::uint32_t thing, bool is_last);
  static void intersect(const std::vector<Meaning>& meanings, Lookup& lookup);

  Table<Postings> things_of_word_;                   // walked through for a misspelt word only, to its least
  Table<std::vector<std::string>> terms_of_phrase_;  // of the vocabulary: synonym or name in singular words -> names
  Table<std::vector<std::vector<std::string>>> surplus_by_first_, surplus_by_last_;  // the longest first
  std::unordered_set<std::string> terms_;                                            // names of the vocabulary
  std::unordered_set<std::string> names_;
  std::size_t longest_name_ = 0;  ///< words
  Table<std::uint32_t> numbers_;
  std::uint32_t next_ = 0;
  std::size_t longest_phrase_ = 1;  ///< words
};

}  // namespace oikos::semantic
