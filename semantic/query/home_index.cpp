// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/home_index.h"

#include <algorithm>
#include <set>

#include "semantic/model/placement.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

std::string join(const std::vector<std::string>& words, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < end; ++i) {
    text += (i > begin ? " " : "") + words[i];
  }
  return text;
}

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::vector<std::string> singularWords(std::string_view text) {
  std::vector<std::string> words = wordsOf(text);
  std::erase_if(words, [](const std::string& word) { return isFiller(word); });
  std::transform(words.begin(), words.end(), words.begin(), singularOf);
  return words;
}

/// At most one letter added, left out, changed, or two neighbours swapped.
bool isOneSlipAway(std::string_view a, std::string_view b) {
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

}  // namespace

const std::string& Thing::id() const {
  switch (kind) {
    case ThingKind::kRoom:
      return room->id.value;
    case ThingKind::kLargeObject:
      return object->id.value;
    case ThingKind::kPart:
      return part->id.value;
    case ThingKind::kKnob:
      return knob->id.value;
    case ThingKind::kSmallObject:
      break;
  }
  return small_object->id.value;
}

std::string Thing::name() const {
  const auto labelled = [](const std::string& label, const std::string& otherwise) { return label.empty() ? spaced(otherwise) : label; };
  switch (kind) {
    case ThingKind::kRoom:
      return room->name;
    case ThingKind::kLargeObject:
      return labelled(object->label, object->type);
    case ThingKind::kPart:
      return labelled(part->label, part->id.value) + " of the " + labelled(object->label, object->type);
    case ThingKind::kKnob:
      return labelled(knob->label, knob->id.value) + " of the " + labelled(object->label, object->type);
    case ThingKind::kSmallObject:
      break;
  }
  if (!small_object->label.empty()) {
    return small_object->label;
  }
  const auto color = std::find_if(small_object->properties.begin(), small_object->properties.end(),
                                  [](const Property& property) { return property.name == "color"; });
  return (color == small_object->properties.end() ? "" : spaced(color->value) + " ") + spaced(small_object->type);
}

Eigen::Isometry3d Thing::T_map_thing() const {
  if (kind == ThingKind::kRoom) {
    return Eigen::Isometry3d::Identity();
  }
  if (kind == ThingKind::kLargeObject) {
    return object->T_map_object.toIsometry();
  }
  if (kind == ThingKind::kSmallObject) {
    const Eigen::Isometry3d T_map_parent =
        object == nullptr ? Eigen::Isometry3d::Identity()
                          : findCarrierInMap(*object, small_object->parent).value_or(object->T_map_object.toIsometry());
    return T_map_parent * small_object->T_parent_object.toIsometry();
  }
  const std::string& holder = kind == ThingKind::kPart ? part->id.value : knob->part.value;
  const Eigen::Isometry3d T_map_part = findCarrierInMap(*object, holder).value_or(object->T_map_object.toIsometry());
  return kind == ThingKind::kPart ? T_map_part : T_map_part * knob->T_part_knob.toIsometry();
}

HomeIndex::HomeIndex(const Home& home) : home_(home) {
  for (const TermKind kind : {TermKind::kRoomType, TermKind::kObjectType, TermKind::kColor}) {
    for (const Term& term : home.vocabulary->of(kind)) {
      std::vector<std::string> phrases = term.synonyms;
      phrases.push_back(spaced(term.name));
      for (const std::string& phrase : phrases) {
        const std::vector<std::string> words = singularWords(phrase);
        longest_phrase_ = std::max(longest_phrase_, words.size());
        name_of_phrase_.try_emplace(join(words, 0, words.size()), term.name);
      }
      terms_.insert(term.name);
    }
  }
  for (const Room& room : home.rooms) {
    add({ThingKind::kRoom, &room, nullptr, nullptr, nullptr, nullptr}, {room.id.value, room.name, spaced(room.type)});
    for (const LargeObject& object : room.objects) {
      addObject(room, object);
    }
    for (const SmallObject& small : room.small_objects) {
      addSmallObject(room, nullptr, small);
    }
  }
  thing_of_id_.reserve(things_.size());
  for (std::uint32_t i = 0; i < things_.size(); ++i) {
    thing_of_id_.try_emplace(things_[i].id(), i);
  }
}

void HomeIndex::addObject(const Room& room, const LargeObject& object) {
  const std::vector<std::string> own{object.id.value, object.label, spaced(object.type)};
  add({ThingKind::kLargeObject, &room, &object, nullptr, nullptr, nullptr}, own);
  if (object.articulation) {
    for (const Part& part : object.articulation->parts) {
      std::vector<std::string> texts = own;
      texts.insert(texts.end(), {part.id.value, part.label});
      add({ThingKind::kPart, &room, &object, &part, nullptr, nullptr}, texts);
    }
    for (const Knob& knob : object.articulation->knobs) {
      std::vector<std::string> texts = own;
      texts.insert(texts.end(), {knob.id.value, knob.label, "knob"});
      add({ThingKind::kKnob, &room, &object, nullptr, &knob, nullptr}, texts);
    }
  }
  for (const SmallObject& small : object.small_objects) {
    addSmallObject(room, &object, small);
  }
}

void HomeIndex::addSmallObject(const Room& room, const LargeObject* carrier, const SmallObject& small) {
  const Part* part = nullptr;
  if (carrier != nullptr && carrier->articulation) {
    const auto& parts = carrier->articulation->parts;
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.id.value == small.parent; });
    part = found == parts.end() ? nullptr : &*found;
  }
  std::vector<std::string> texts{small.id.value, small.label, spaced(small.type)};
  for (const Property& property : small.properties) {
    texts.push_back(spaced(property.value));
  }
  add({ThingKind::kSmallObject, &room, carrier, part, nullptr, &small}, texts);
}

void HomeIndex::add(const Thing& thing, const std::vector<std::string>& texts) {
  const auto number = static_cast<std::uint32_t>(things_.size());
  things_.push_back(thing);
  for (const std::string& text : texts) {
    const std::vector<std::string> words = singularWords(text);
    std::vector<std::string> keys = keysOf(words);
    keys.insert(keys.end(), words.begin(), words.end());
    for (const std::string& key : keys) {
      std::vector<std::uint32_t>& list = things_of_word_[key];
      if (list.empty() || list.back() != number) {
        list.push_back(number);
      }
    }
  }
}

/// The longest phrases of the vocabulary by their name, everything else word by word.
std::vector<std::string> HomeIndex::keysOf(const std::vector<std::string>& words) const {
  std::vector<std::string> keys;
  for (std::size_t begin = 0; begin < words.size();) {
    std::size_t length = std::min(longest_phrase_, words.size() - begin);
    auto name = name_of_phrase_.find(join(words, begin, begin + length));
    while (name == name_of_phrase_.end() && length > 1) {
      name = name_of_phrase_.find(join(words, begin, begin + --length));
    }
    keys.push_back(name == name_of_phrase_.end() ? words[begin] : name->second);
    begin += length;
  }
  return keys;
}

/// The first in the alphabet of the known words that one typing error makes of it; empty: none.
std::string HomeIndex::correctionOf(const std::string& word) const {
  constexpr std::size_t kShortest = 4;
  std::string best;
  if (word.size() < kShortest) {
    return best;
  }
  const auto offer = [&](const std::string& known, const std::string& key) {
    if (isOneSlipAway(word, known) && (best.empty() || key < best)) {
      best = key;
    }
  };
  for (const auto& [phrase, name] : name_of_phrase_) {
    if (things_of_word_.contains(name)) {
      offer(phrase, name);
    }
  }
  if (best.empty()) {
    for (const auto& [known, list] : things_of_word_) {
      offer(known, known);
    }
  }
  return best;
}

Lookup HomeIndex::find(const std::vector<std::string>& words) const {
  Lookup lookup;
  std::vector<std::string> plain = words;
  std::erase_if(plain, [](const std::string& word) { return isFiller(word); });
  std::transform(plain.begin(), plain.end(), plain.begin(), singularOf);
  static const std::vector<std::uint32_t> nothing;
  std::vector<const std::vector<std::uint32_t>*> lists;
  for (const std::string& key : keysOf(plain)) {
    auto list = things_of_word_.find(key);
    const bool in_vocabulary = terms_.contains(key);
    if (list == things_of_word_.end() && !in_vocabulary) {
      if (const std::string meant = correctionOf(key); !meant.empty()) {
        lookup.corrected.push_back(key + " -> " + meant);
        list = things_of_word_.find(meant);
      }
    }
    if (list == things_of_word_.end() && !in_vocabulary) {
      lookup.unknown.push_back(key);
    } else {
      lists.push_back(list == things_of_word_.end() ? &nothing : &list->second);
    }
  }
  if (!lookup.unknown.empty() || lists.empty()) {
    return lookup;
  }
  std::sort(lists.begin(), lists.end(), [](const auto* a, const auto* b) { return a->size() < b->size(); });
  for (const std::uint32_t number : *lists.front()) {
    if (std::all_of(lists.begin() + 1, lists.end(),
                    [&](const auto* list) { return std::binary_search(list->begin(), list->end(), number); })) {
      lookup.things.push_back(number);
    }
  }
  return lookup;
}

const Thing* HomeIndex::findById(std::string_view id) const {
  const auto found = thing_of_id_.find(id);
  return found == thing_of_id_.end() ? nullptr : &things_[found->second];
}

}  // namespace oikos::semantic
