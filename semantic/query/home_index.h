// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "semantic/model/home.h"
#include "semantic/query/home_words.h"
#include "semantic/query/thing.h"

namespace oikos::semantic {

/// From words to things without looking at every thing: each word has the list of what it fits, and the lists are intersected from the
/// shortest. Words are those of labels, ids, types, properties and room names, and the vocabulary's synonyms; a word of four letters or
/// more that fits nothing may have one typing error. Keeps its home alive. Immutable; copies share everything. Thread-safe.
class HomeIndex {
 public:
  explicit HomeIndex(Home home);
  /// Of a snapshot that owns its home: std::shared_ptr<const Home>(snapshot, &snapshot->home).
  explicit HomeIndex(std::shared_ptr<const Home> home);
  /// Of a home that differs from `like`'s in states only: takes over its words, in O(things) without a look at any word, and the numbers
  /// of its things. A home that differs in more gets an index of its own.
  HomeIndex(const HomeIndex& like, std::shared_ptr<const Home> home);

  [[nodiscard]] const Home& home() const { return *home_; }
  /// In the order of the file that the words were read from: a room, then each piece of its furniture followed by its parts, knobs and
  /// small objects, then what lies on its floor.
  [[nodiscard]] const Thing& thing(std::uint32_t number) const { return (*things_)[number]; }
  [[nodiscard]] std::size_t size() const { return things_->size(); }
  [[nodiscard]] Lookup find(const std::vector<std::string>& words) const { return words_->find(words); }
  /// Null: no such id. Of rooms, furniture, parts, knobs and small objects.
  [[nodiscard]] const Thing* findById(std::string_view id) const;
  [[nodiscard]] std::uint32_t numberOf(const Thing& thing) const { return static_cast<std::uint32_t>(&thing - things_->data()); }
  [[nodiscard]] const HomeWords& words() const { return *words_; }

 private:
  void build();
  [[nodiscard]] bool relink(const HomeIndex& like);

  std::shared_ptr<const Home> home_;
  std::shared_ptr<const HomeWords> words_;
  std::shared_ptr<const std::vector<Thing>> things_;
};

}  // namespace oikos::semantic
