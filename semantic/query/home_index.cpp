// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/home_index.h"

#include <algorithm>
#include <utility>

namespace oikos::semantic {

namespace {

/// Calls `visit` with every thing of the home, in the order of its numbers.
template <class Visit>
class HomeWalk {
 public:
  explicit HomeWalk(const Visit& visit) : visit_(visit) {}

  void walk(const Home& home) const {
    for (const Room& room : home.rooms) {
      visit_(Thing{ThingKind::kRoom, &room, nullptr, nullptr, nullptr, nullptr});
      for (const LargeObject& object : room.objects) {
        walk(room, object);
      }
      for (const SmallObject& small : room.small_objects) {
        visit_(Thing{ThingKind::kSmallObject, &room, nullptr, nullptr, nullptr, &small});
      }
    }
  }

 private:
  void walk(const Room& room, const LargeObject& object) const {
    visit_(Thing{ThingKind::kLargeObject, &room, &object, nullptr, nullptr, nullptr});
    if (object.articulation) {
      for (const Part& part : object.articulation->parts) {
        visit_(Thing{ThingKind::kPart, &room, &object, &part, nullptr, nullptr});
      }
      for (const Knob& knob : object.articulation->knobs) {
        visit_(Thing{ThingKind::kKnob, &room, &object, nullptr, &knob, nullptr});
      }
    }
    for (const SmallObject& small : object.small_objects) {
      visit_(Thing{ThingKind::kSmallObject, &room, &object, carrierOf(object, small), nullptr, &small});
    }
  }

  static const Part* carrierOf(const LargeObject& object, const SmallObject& small) {
    if (!object.articulation) {
      return nullptr;
    }
    const auto& parts = object.articulation->parts;
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.id.value == small.parent; });
    return found == parts.end() ? nullptr : &*found;
  }

  const Visit& visit_;
};

}  // namespace

HomeIndex::HomeIndex(Home home) : HomeIndex(std::make_shared<const Home>(std::move(home))) {}

HomeIndex::HomeIndex(std::shared_ptr<const Home> home) : home_(std::move(home)) {
  build();
}

HomeIndex::HomeIndex(const HomeIndex& like, std::shared_ptr<const Home> home) : home_(std::move(home)) {
  if (!relink(like)) {
    build();
  }
}

void HomeIndex::build() {
  const auto words = std::make_shared<HomeWords>(*home_->vocabulary);
  const auto things = std::make_shared<std::vector<Thing>>();
  const auto add = [&](const Thing& thing) {
    words->add(thing);
    things->push_back(thing);
  };
  HomeWalk(add).walk(*home_);
  words_ = words;
  things_ = things;
}

/// Whether every thing of `like` is there again, and nothing else.
bool HomeIndex::relink(const HomeIndex& like) {
  const auto things = std::make_shared<std::vector<Thing>>(like.size());
  std::size_t found = 0;
  std::size_t walked = 0;
  std::uint32_t next = 0;
  const auto place = [&](const Thing& thing) {
    // Most things follow what they followed: no look-up.
    const bool follows = next < like.size() && like.thing(next).id() == thing.id();
    const auto number = follows ? std::optional(next) : like.words_->findNumber(thing.id());
    next = number.value_or(next) + 1;
    ++walked;
    if (number && (*things)[*number].room == nullptr && like.thing(*number).kind == thing.kind) {
      (*things)[*number] = thing;
      ++found;
    }
  };
  HomeWalk(place).walk(*home_);
  if (found != like.size() || walked != found) {
    return false;
  }
  words_ = like.words_;
  things_ = things;
  return true;
}

const Thing* HomeIndex::findById(std::string_view id) const {
  const auto number = words_->findNumber(id);
  return number ? &thing(*number) : nullptr;
}

}  // namespace oikos::semantic
