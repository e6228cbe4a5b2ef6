// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/answer.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "core/base/number_text.h"
#include "semantic/query/question.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kMostFound = 20;
constexpr std::size_t kMostSpoken = 5;

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text;
}

std::string openingText(const Joint& joint) {
  return joint.type == JointType::kRevolute ? base::toFixedText(openingOf(joint) / kRadPerDeg, 0) + " degrees"
                                            : base::toFixedText(openingOf(joint) * 100.0, 0) + " cm";
}

std::string placeText(const Thing& thing) {
  const std::string in_room = " in the " + thing.room->name;
  switch (thing.kind) {
    case ThingKind::kRoom:
      return "a room of the home";
    case ThingKind::kLargeObject:
      return in_room.substr(1);
    case ThingKind::kPart:
    case ThingKind::kKnob:
      return in_room.substr(1);
    case ThingKind::kSmallObject:
      break;
  }
  if (thing.object == nullptr) {
    return "on the floor" + in_room;
  }
  const bool in_moving_part = thing.part != nullptr && !thing.part->parent.value.empty();
  const Thing carrier{in_moving_part ? ThingKind::kPart : ThingKind::kLargeObject,
                      thing.room,
                      thing.object,
                      in_moving_part ? thing.part : nullptr,
                      nullptr,
                      nullptr};
  return std::string(base::toString(thing.small_object->relation)) + " the " + carrier.name() + in_room;
}

using Things = std::vector<const Thing*>;

/// A part or knob that fits only because its furniture fits is not what was meant.
Things withoutPartsOfOthers(const Things& things) {
  std::set<const LargeObject*> whole;
  for (const Thing* thing : things) {
    if (thing->kind == ThingKind::kLargeObject) {
      whole.insert(thing->object);
    }
  }
  Things kept;
  std::copy_if(things.begin(), things.end(), std::back_inserter(kept), [&](const Thing* thing) {
    return (thing->kind != ThingKind::kPart && thing->kind != ThingKind::kKnob) || !whole.contains(thing->object);
  });
  return kept;
}

/// The places that some words may mean, for one look at each thing.
class Places {
 public:
  Places(const Things& things, Relation relation) : places_(things), relation_(relation) {
    for (const Thing* thing : things) {
      rooms_.insert(thing->kind == ThingKind::kRoom ? thing->room : nullptr);
      objects_.insert(thing->kind == ThingKind::kLargeObject ? thing->object : nullptr);
      parts_.insert(thing->kind == ThingKind::kPart ? thing->part : nullptr);
    }
    rooms_.erase(nullptr);
    objects_.erase(nullptr);
    parts_.erase(nullptr);
  }

  [[nodiscard]] bool contain(const Thing& thing) const {
    if (thing.kind == ThingKind::kRoom) {
      return false;
    }
    if (rooms_.contains(thing.room)) {
      return true;
    }
    if (thing.kind != ThingKind::kSmallObject) {
      return thing.kind != ThingKind::kLargeObject && objects_.contains(thing.object);
    }
    return thing.small_object->relation == relation_ && (objects_.contains(thing.object) || parts_.contains(thing.part));
  }

  /// Everything there: furniture and small objects. What a place holds comes right after it in the index.
  [[nodiscard]] Things contents(const HomeIndex& index) const {
    Things all;
    if (places_.empty()) {
      return all;
    }
    const Thing* const end = &index.thing(0) + index.size();
    for (const Thing* place : places_) {
      for (const Thing* thing = place + 1;
           thing != end && (place->kind == ThingKind::kRoom ? thing->room == place->room : thing->object == place->object); ++thing) {
        if ((thing->kind == ThingKind::kLargeObject || thing->kind == ThingKind::kSmallObject) && contain(*thing)) {
          all.push_back(thing);
        }
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  Things places_;
  Relation relation_;
  std::set<const Room*> rooms_;
  std::set<const LargeObject*> objects_;
  std::set<const Part*> parts_;
};

class Answerer {
 public:
  Answerer(const HomeIndex& index, const Question& question) : index_(index), question_(question) {}

  Answer run() {
    Things things;
    if (!question_.thing.empty() && !lookUp(question_.thing, things)) {
      return std::move(answer_);
    }
    if (question_.place) {
      Things places;
      if (!lookUp(question_.place->words, places)) {
        return std::move(answer_);
      }
      const Places place(withoutPartsOfOthers(places), question_.place->relation);
      if (question_.thing.empty()) {
        things = place.contents(index_);
      } else {
        std::erase_if(things, [&](const Thing* thing) { return !place.contain(*thing); });
      }
    }
    answer(things);
    answer_.total = std::max(answer_.total, answer_.found.size());
    return std::move(answer_);
  }

 private:
  bool lookUp(const std::vector<std::string>& words, Things& things) {
    const Lookup lookup = index_.find(words);
    answer_.corrected.insert(answer_.corrected.end(), lookup.corrected.begin(), lookup.corrected.end());
    if (!lookup.unknown.empty()) {
      answer_.status = AnswerStatus::kUnknownWord;
      answer_.sentence = "Nothing in this home is called '" + joined(lookup.unknown, "', '") + "'.";
      return false;
    }
    for (const std::uint32_t number : lookup.things) {
      things.push_back(&index_.thing(number));
    }
    return true;
  }

  void answer(const Things& all) {
    const Things things = withoutPartsOfOthers(all);
    switch (question_.kind) {
      case QuestionKind::kWhere:
        return where(things);
      case QuestionKind::kContents:
        return contents(things);
      case QuestionKind::kCount:
        return count(things);
      case QuestionKind::kIsThere:
        return isThere(things);
      case QuestionKind::kIsOpen:
      case QuestionKind::kWhichOpen:
      case QuestionKind::kHowFar:
        return openness(things);
      case QuestionKind::kSetting:
        return setting(all);
    }
  }

  [[nodiscard]] std::string asked() const { return joined(question_.thing, " "); }

  void nothingFits() {
    answer_.status = AnswerStatus::kNothingFits;
    const std::string where =
        question_.place ? " " + std::string(base::toString(question_.place->relation)) + " the " + joined(question_.place->words, " ") : "";
    answer_.sentence = question_.thing.empty() ? "I know of nothing" + where + "." : "I know of no " + asked() + where + ".";
  }

  void take(const Things& things) {
    answer_.status = AnswerStatus::kAnswered;
    answer_.total = things.size();
    for (std::size_t i = 0; i < std::min(things.size(), kMostFound); ++i) {
      answer_.found.push_back(describe(*things[i]));
    }
  }

  /// "a, b and 3 more" of what `say` makes of each.
  template <class Say>
  [[nodiscard]] static std::string list(const Things& things, const Say& say) {
    std::string text;
    const std::size_t spoken = std::min(things.size(), kMostSpoken);
    for (std::size_t i = 0; i < spoken; ++i) {
      text += i == 0 ? "" : i + 1 == things.size() ? " and " : ", ";
      text += say(*things[i]);
    }
    return things.size() > spoken ? text + " and " + std::to_string(things.size() - spoken) + " more" : text;
  }

  static std::string theName(const Thing& thing) { return "the " + thing.name(); }

  void where(const Things& things) {
    if (things.empty()) {
      return nothingFits();
    }
    take(things);
    if (things.size() == 1) {
      answer_.sentence = capitalised(theName(*things[0])) + " is " + placeText(*things[0]) + ".";
      return;
    }
    answer_.sentence = std::to_string(things.size()) +
                       " things fit: " + list(things, [](const Thing& thing) { return theName(thing) + " " + placeText(thing); }) + ".";
  }

  void contents(const Things& things) {
    if (things.empty()) {
      return nothingFits();
    }
    take(things);
    answer_.sentence = capitalised(list(things, theName)) + (things.size() == 1 ? " is " : " are ") +
                       std::string(base::toString(question_.place->relation)) + " the " + joined(question_.place->words, " ") + ".";
  }

  void count(const Things& things) {
    take(things);
    answer_.sentence = things.empty() ? "None." : std::to_string(things.size()) + ": " + list(things, [](const Thing& thing) {
                                                    return theName(thing) + " " + placeText(thing);
                                                  }) + ".";
  }

  void isThere(const Things& things) {
    take(things);
    answer_.sentence = things.empty()
                           ? "Not that I know."
                           : "Yes: " + list(things, [](const Thing& thing) { return theName(thing) + " is " + placeText(thing); }) + ".";
  }

  static std::string stateText(const Thing& thing) {
    std::vector<std::string> states;
    for (const Joint* joint : jointsOf(thing)) {
      const bool whole = thing.kind == ThingKind::kLargeObject && jointsOf(thing).size() > 1;
      const auto& parts = thing.object->articulation->parts;
      const auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.id == joint->child; });
      const std::string name = whole && part != parts.end() ? "its " + (part->label.empty() ? part->id.value : part->label) + " is " : "";
      states.push_back(name + (isOpen(*joint) ? "open by " + openingText(*joint) : "closed"));
    }
    return theName(thing) + (states.size() > 1 ? ": " : " is ") + joined(states, ", ");
  }

  void openness(const Things& things) {
    Things movable;
    for (const Thing* thing : things) {
      const std::vector<const Joint*> joints = jointsOf(*thing);
      const bool open = std::any_of(joints.begin(), joints.end(), [](const Joint* joint) { return isOpen(*joint); });
      if (!joints.empty() && (question_.kind != QuestionKind::kWhichOpen || open == question_.open)) {
        movable.push_back(thing);
      }
    }
    if (movable.empty()) {
      if (question_.kind != QuestionKind::kWhichOpen || things.empty()) {
        nothingFits();
        answer_.sentence = things.empty() ? answer_.sentence : "I know of no way to open the " + asked() + ".";
        return;
      }
      answer_.status = AnswerStatus::kAnswered;
      answer_.sentence = "None.";
      return;
    }
    take(movable);
    answer_.sentence = capitalised(list(movable, stateText)) + ".";
  }

  void setting(const Things& things) {
    Things knobs;
    std::copy_if(things.begin(), things.end(), std::back_inserter(knobs),
                 [](const Thing* thing) { return thing->kind == ThingKind::kKnob; });
    if (knobs.empty()) {
      nothingFits();
      answer_.sentence = things.empty() ? answer_.sentence : "The " + asked() + " has nothing that could be set.";
      return;
    }
    take(knobs);
    answer_.sentence =
        capitalised(list(knobs, [](const Thing& thing) { return theName(thing) + " is set to " + thing.knob->current; })) + ".";
  }

  const HomeIndex& index_;
  const Question& question_;
  Answer answer_;
};

}  // namespace

Answer answerQuestion(const HomeIndex& index, std::string_view text) {
  const ParsedQuestion parsed = parseQuestion(text);
  if (!parsed.question) {
    Answer answer;
    answer.sentence =
        parsed.not_understood.empty() ? "I did not understand the question." : "I did not understand '" + parsed.not_understood + "'.";
    return answer;
  }
  return Answerer(index, *parsed.question).run();
}

}  // namespace oikos::semantic
