// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/home_words.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/nearest_name.h"
#include "semantic/query/grammar_words.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

std::string join(const std::vector<std::string>& words, std::size_t begin, std::size_t count) {
  std::string text;
  for (std::size_t i = begin; i < begin + count; ++i) {
    text += (i > begin ? " " : "") + words[i];
  }
  return text;
}

std::vector<std::string> plainWords(std::string_view text) {
  std::vector<std::string> words = wordsOf(text);
  std::erase_if(words, [](const std::string& word) { return isFiller(word); });
  return words;
}

std::vector<std::string> singular(std::vector<std::string> words) {
  std::transform(words.begin(), words.end(), words.begin(), singularOf);
  return words;
}

bool isSentenceWord(const std::string& word) {
  constexpr std::array<std::string_view, 10> words{"of", "on", "in", "with", "and", "for", "to", "at", "under", "or"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::vector<std::uint32_t> Lookup::best() const {
  int least = std::numeric_limits<int>::max();
  for (const Match& match : matches) {
    least = std::min(least, match.rank);
  }
  std::vector<std::uint32_t> things;
  for (const Match& match : matches) {
    if (match.rank == least) {
      things.push_back(match.thing);
    }
  }
  return things;
}

HomeWords::HomeWords(const Vocabulary& vocabulary) {
  for (const Term& term : vocabulary.of(TermKind::kSurplus)) {
    addSurplus(spaced(term.name));
    std::for_each(term.synonyms.begin(), term.synonyms.end(), [&](const std::string& phrase) { addSurplus(phrase); });
  }
  for (const TermKind kind : {TermKind::kRoomType, TermKind::kObjectType, TermKind::kColor}) {
    for (const Term& term : vocabulary.of(kind)) {
      std::vector<std::string> phrases = term.synonyms;
      phrases.push_back(spaced(term.name));
      for (const std::string& phrase : phrases) {
        const std::vector<std::string> words = singular(plainWords(phrase));
        longest_phrase_ = std::max(longest_phrase_, words.size());
        terms_of_phrase_[join(words, 0, words.size())].push_back(term.name);
        addName(phrase);
      }
      terms_.insert(term.name);
    }
  }
}

void HomeWords::add(const Thing& thing) {
  // A part's id says what it belongs to: "bathroom-cabinet-left-door" is no "bathroom door".
  std::string spoken;
  std::vector<Text> texts{{thing.id(), false, thing.kind != ThingKind::kPart && thing.kind != ThingKind::kKnob, false, true}};
  const auto addFurniture = [&](bool own) {
    texts.push_back({thing.object->id.value, false, own});
    texts.push_back({thing.object->label, false, own});
    texts.push_back({thing.object->type, own, own});
  };
  switch (thing.kind) {
    case ThingKind::kRoom:
      texts.insert(texts.end(), {{thing.room->name}, {thing.room->type, true}});
      break;
    case ThingKind::kLargeObject:
      addFurniture(true);
      break;
    case ThingKind::kPart:
      spoken = partName(*thing.object, *thing.part);
      spoken = thing.part->label.empty() && spoken == thing.object->type ? "" : spoken;  // the leaf of a door is the door
      texts.push_back({spoken, true});
      addFurniture(false);
      break;
    case ThingKind::kKnob:
      texts.insert(texts.end(), {{spoken = knobName(*thing.object, *thing.knob)}, {"knob", true}});
      addFurniture(false);
      break;
    case ThingKind::kSmallObject:
      texts.insert(texts.end(), {{thing.small_object->label}, {thing.small_object->type, true}});
      for (const Property& property : thing.small_object->properties) {
        texts.push_back({property.value, false, true, true});
      }
  }
  for (const Text& text : texts) {
    addText(next_, text);
  }
  if (thing.kind == ThingKind::kRoom) {
    addPosting("rooms", {next_, kOwn | kHead | kType | kWhole});  // all of them; "the room" may be the living room
  }
  numbers_.try_emplace(thing.id(), next_++);
}

void HomeWords::addText(std::uint32_t number, const Text& text) {
  const std::vector<std::string> words = plainWords(text.text);
  const std::vector<std::string> singulars = singular(words);
  const std::vector<Phrase> phrases = phrasesOf(singulars);
  const std::uint8_t own = text.is_own ? kOwn : 0;
  for (const Phrase& phrase : phrases) {
    const bool last = &phrase == &phrases.back();
    const int whole = (text.is_type ? kType : 0) | (phrases.size() == 1 ? kWhole : 0) | (text.is_property ? 0 : kNoun);
    const auto fit = static_cast<std::uint8_t>(text.is_own && last ? own | kHead | whole : own);
    const auto named = terms_of_phrase_.find(phrase.text);
    const bool is_term = phrase.count == 1 && terms_.contains(words[phrase.first]);
    if (is_term || named == terms_of_phrase_.end()) {
      addPosting(is_term ? words[phrase.first] : phrase.text, {number, fit});
    } else {
      for (const std::string& term : named->second) {
        addPosting(term, {number, fit});
      }
      if (phrase.count > 1 && !text.is_id) {  // whose label says so was meant rather than others of its type
        addPosting(phrase.text, {number, fit});
      }
    }
    for (std::size_t i = phrase.first; i < phrase.first + phrase.count; ++i) {
      const bool is_phrase = phrase.count == 1;
      const bool ends = last && text.is_own && i + 1 == phrase.first + phrase.count;
      const std::uint8_t word_fit = is_phrase ? fit : static_cast<std::uint8_t>(own | (ends ? kHead : 0));
      addPosting(is_term ? words[i] : singulars[i], {number, word_fit});
    }
  }
  if (text.is_own) {
    addName(text.text);
  }
}

void HomeWords::addPosting(const std::string& key, Posting posting) {
  Postings& list = things_of_word_[key];
  if (!list.empty() && list.back().thing == posting.thing) {
    list.back().fit |= posting.fit;
  } else {
    list.push_back(posting);
  }
}

void HomeWords::addName(std::string_view text) {
  if (text.find(' ') == std::string_view::npos) {
    return;
  }
  const std::vector<std::string> words = wordsOf(text);
  if (words.size() > 1 && std::any_of(words.begin(), words.end(), isSentenceWord)) {
    names_.insert(join(singular(words), 0, words.size()));
    longest_name_ = std::max(longest_name_, words.size());
  }
}

std::vector<std::string> HomeWords::joinNames(const std::vector<std::string>& words) const {
  if (names_.empty() || std::none_of(words.begin(), words.end(), isSentenceWord)) {
    return words;
  }
  const std::vector<std::string> singulars = singular(words);
  std::vector<std::string> joined;
  for (std::size_t i = 0; i < words.size();) {
    std::size_t count = std::min(longest_name_, words.size() - i);
    while (count > 1 && !names_.contains(join(singulars, i, count))) {
      --count;
    }
    joined.push_back(join(words, i, std::max<std::size_t>(count, 1)));
    i += std::max<std::size_t>(count, 1);
  }
  return joined;
}

std::vector<HomeWords::Phrase> HomeWords::phrasesOf(const std::vector<std::string>& words) const {
  std::vector<Phrase> phrases;
  for (std::size_t begin = 0; begin < words.size();) {
    std::size_t count = std::min(longest_phrase_, words.size() - begin);
    while (count > 1 && !terms_of_phrase_.contains(join(words, begin, count))) {
      --count;
    }
    phrases.push_back({join(words, begin, count), begin, count});
    begin += count;
  }
  return phrases;
}

std::size_t HomeWords::sizeOf(const Meaning& meaning) {
  std::size_t total = 0;
  for (const Sense& sense : meaning) {
    total += sense.things->size();
  }
  return total;
}

HomeWords::Meaning HomeWords::meaningOf(const std::string& phrase, const std::string& verbatim) const {
  static const Postings nothing;
  Meaning meaning;
  const auto add = [&](const std::string& word) {
    const auto list = things_of_word_.find(word);
    if (list != things_of_word_.end()) {
      meaning.push_back({&list->second, false});
    } else if (terms_.contains(word)) {
      meaning.push_back({&nothing, false});
    }
  };
  add(phrase);
  if (verbatim != phrase) {
    add(verbatim);
  }
  if (const auto terms = terms_of_phrase_.find(phrase); terms != terms_of_phrase_.end()) {
    for (const std::string& term : terms->second) {
      if (term != phrase && term != verbatim) {
        const auto list = things_of_word_.find(term);
        meaning.push_back({list == things_of_word_.end() ? &nothing : &list->second, true});
      }
    }
  }
  return meaning;
}

bool HomeWords::isNoun(const std::string& word) const {
  const Meaning meaning = meaningOf(singularOf(word), word);
  return std::any_of(meaning.begin(), meaning.end(), [](const Sense& sense) {
    return std::any_of(sense.things->begin(), sense.things->end(), [](const Posting& posting) { return (posting.fit & kNoun) != 0; });
  });
}

bool HomeWords::knows(const std::string& word) const {
  return !meaningOf(singularOf(word), word).empty();
}

/// The first in the alphabet of the known words that one typing error makes of it; empty: none.
std::string HomeWords::correctionOf(const std::string& word) const {
  constexpr std::size_t kShortest = 4;
  std::string best;
  if (word.size() < kShortest || isGrammarWord(word)) {
    return best;
  }
  const auto offer = [&](const std::string& known) {
    if ((best.empty() || known < best) && isOneSlipAway(word, known)) {
      best = known;
    }
  };
  for (const auto& [phrase, terms] : terms_of_phrase_) {
    if (std::any_of(terms.begin(), terms.end(), [&](const std::string& term) { return things_of_word_.contains(term); })) {
      offer(phrase);
    }
  }
  if (best.empty()) {
    for (const auto& [known, list] : things_of_word_) {
      offer(known);
    }
  }
  return best;
}

std::vector<std::string> HomeWords::nearestWords(const std::string& word) const {
  constexpr std::size_t kMost = 3;
  constexpr std::size_t kLong = 6;
  const int most_slips = word.size() < kLong ? 1 : 2;  // "dear" is no "desk"
  std::vector<std::pair<int, std::string>> near;
  for (const auto& [known, list] : things_of_word_) {
    const std::size_t longer = std::max(known.size(), word.size());
    if (longer - std::min(known.size(), word.size()) <= static_cast<std::size_t>(most_slips) && longer > 3) {
      if (const int slips = base::editDistance(word, known); slips <= most_slips) {
        near.emplace_back(slips, known);
      }
    }
  }
  std::sort(near.begin(), near.end());
  std::vector<std::string> words;
  for (const auto& [slips, known] : near) {
    if (words.size() < kMost) {
      words.push_back(spaced(known));
    }
  }
  return words;
}

std::optional<int> HomeWords::rankOf(const Meaning& meaning, std::uint32_t thing, bool is_last) {
  std::optional<int> rank;
  const auto look = [&](const Postings& list, bool by_other_word) {
    const auto found =
        std::lower_bound(list.begin(), list.end(), thing, [](const Posting& posting, std::uint32_t t) { return posting.thing < t; });
    if (found == list.end() || found->thing != thing) {
      return;
    }
    const std::uint8_t fit = found->fit;
    int here = (fit & kOwn) == 0 ? (is_last ? 5 : by_other_word ? 4 : 3) : is_last ? 2 : 0;
    if (is_last && (fit & kHead) != 0) {
      here = (fit & (kType | kWhole)) != 0 && !by_other_word ? 0 : 1;
    }
    rank = std::min(rank.value_or(here), here);
  };
  for (const Sense& sense : meaning) {
    look(*sense.things, sense.by_other_word);
  }
  return rank;
}

void HomeWords::intersect(const std::vector<Meaning>& meanings, Lookup& lookup) {
  const auto least =
      std::min_element(meanings.begin(), meanings.end(), [](const Meaning& a, const Meaning& b) { return sizeOf(a) < sizeOf(b); });
  std::vector<std::uint32_t> candidates;
  candidates.reserve(sizeOf(*least));
  for (const Sense& sense : *least) {
    for (const Posting& posting : *sense.things) {
      candidates.push_back(posting.thing);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  for (const std::uint32_t thing : candidates) {
    std::optional<int> rank = 0;
    for (std::size_t i = 0; i < meanings.size() && rank; ++i) {
      const auto here = rankOf(meanings[i], thing, i + 1 == meanings.size());
      rank = here ? std::optional(std::max(*rank, *here)) : std::nullopt;
    }
    if (rank) {
      lookup.matches.push_back({thing, *rank});
    }
  }
}

Lookup HomeWords::find(const std::vector<std::string>& words) const {
  Lookup lookup;
  std::vector<std::string> plain;
  for (const std::string& word : words) {
    if (word.find(' ') == std::string::npos) {
      plain.push_back(word);
    } else {
      const std::vector<std::string> parts = plainWords(word);
      plain.insert(plain.end(), parts.begin(), parts.end());
    }
  }
  std::erase_if(plain, [](const std::string& word) { return isFiller(word); });
  std::vector<Meaning> meanings;
  for (const Phrase& phrase : phrasesOf(singular(plain))) {
    const std::string& verbatim = phrase.count == 1 ? plain[phrase.first] : phrase.text;
    Meaning meaning = meaningOf(phrase.text, verbatim);
    if (meaning.empty()) {
      const std::string meant = correctionOf(phrase.text);
      if (meant.empty()) {
        lookup.unknown.push_back(verbatim);
        continue;
      }
      lookup.corrected.push_back(phrase.text + " -> " + meant);
      meaning = meaningOf(meant, meant);
    }
    meanings.push_back(std::move(meaning));
  }
  if (lookup.unknown.empty() && !meanings.empty()) {
    intersect(meanings, lookup);
  }
  return lookup;
}

std::optional<std::uint32_t> HomeWords::findNumber(std::string_view id) const {
  const auto found = numbers_.find(id);
  return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace oikos::semantic
