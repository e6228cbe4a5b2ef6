// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::semantic {

enum class ThingKind { kRoom, kLargeObject, kPart, kKnob, kSmallObject };

/// Anything in a home that has a name, with the way down to it.
struct Thing {
  ThingKind kind = ThingKind::kRoom;
  const Room* room = nullptr;
  const LargeObject* object = nullptr;  ///< null: a room, or a small object on its floor
  const Part* part = nullptr;           ///< of a part; of a small object: that carries it
  const Knob* knob = nullptr;
  const SmallObject* small_object = nullptr;

  [[nodiscard]] const std::string& id() const;
  /// As a person would say it: the label, else colour and type.
  [[nodiscard]] std::string name() const;
  /// Of a room: the identity.
  [[nodiscard]] Eigen::Isometry3d T_map_thing() const;
};

/// What was meant by some words, one after another.
struct Lookup {
  std::vector<std::uint32_t> things;   ///< numbers of things that all words fit, ascending
  std::vector<std::string> unknown;    ///< words that mean nothing here; one that the vocabulary knows only fits nothing
  std::vector<std::string> corrected;  ///< "was -> taken for"
};

/// From words to things without looking at every thing: each word has the list of what it fits, and the lists are intersected from the
/// shortest. Words are those of labels, ids, types, properties and room names, and the vocabulary's synonyms; a word of four letters or
/// more that fits nothing may have one typing error. The home must outlive the index and not change. Thread-safe.
class HomeIndex {
 public:
  explicit HomeIndex(const Home& home);

  [[nodiscard]] const Home& home() const { return home_; }
  /// In the order of the file: a room, then each piece of its furniture followed by its parts, knobs and small objects, then what lies on
  /// its floor.
  [[nodiscard]] const Thing& thing(std::uint32_t number) const { return things_[number]; }
  [[nodiscard]] std::size_t size() const { return things_.size(); }
  [[nodiscard]] Lookup find(const std::vector<std::string>& words) const;
  /// Null: no such id.
  [[nodiscard]] const Thing* findById(std::string_view id) const;

 private:
  void addObject(const Room& room, const LargeObject& object);
  void addSmallObject(const Room& room, const LargeObject* carrier, const SmallObject& small);
  void add(const Thing& thing, const std::vector<std::string>& texts);
  [[nodiscard]] std::vector<std::string> keysOf(const std::vector<std::string>& words) const;
  [[nodiscard]] std::string correctionOf(const std::string& word) const;

  const Home& home_;
  std::vector<Thing> things_;
  std::unordered_map<std::string, std::vector<std::uint32_t>> things_of_word_;  // walked through for a misspelt word only, to its least
  std::unordered_map<std::string, std::string> name_of_phrase_;                 // of the vocabulary: synonym or name in words -> name
  std::unordered_set<std::string> terms_;                                       // names of the vocabulary
  std::unordered_map<std::string_view, std::uint32_t> thing_of_id_;
  std::size_t longest_phrase_ = 1;  ///< words
};

}  // namespace oikos::semantic
