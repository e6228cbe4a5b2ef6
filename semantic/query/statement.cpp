// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/statement.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "semantic/query/answer.h"
#include "semantic/query/found_thing.h"
#include "semantic/query/resolver.h"
#include "semantic/query/sentence.h"
#include "semantic/query/thing_phrase.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

struct Parts {
  Words subject;
  Words predicate;
};

bool isOneOf(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// "X | is PREDICATE", "I put X | PREDICATE".
std::optional<Parts> split(Words words) {
  if (words.size() > 3 && isOneOf(words[0], {"i", "we"})) {
    std::size_t verb = isOneOf(words[1], {"have"}) ? 2 : 1;
    if (!isOneOf(words[verb], {"put", "left", "moved", "placed", "stored", "laid"})) {
      return std::nullopt;
    }
    for (++verb; verb < words.size(); ++verb) {
      if (findRelationWords(words.subspan(verb))) {
        const std::size_t first = isOneOf(words[1], {"have"}) ? 3 : 2;
        return Parts{words.subspan(first, verb - first), words.subspan(verb)};
      }
    }
    return std::nullopt;
  }
  const auto be = std::find_if(words.begin(), words.end(), [](const std::string& word) { return isOneOf(word, {"is", "are"}); });
  const auto at = static_cast<std::size_t>(be - words.begin());
  if (at == 0 || at + 1 >= words.size()) {
    return std::nullopt;
  }
  Words predicate = words.subspan(at + 1);
  while (predicate.size() > 1 && isOneOf(predicate.front(), {"now", "actually", "really", "lying", "standing", "kept", "back"})) {
    predicate = predicate.subspan(1);
  }
  return Parts{words.first(at), predicate};
}

std::optional<Relation> relationFor(PlaceRelation relation, const Thing& place) {
  switch (relation) {
    case PlaceRelation::kOn:
      return Relation::kOn;
    case PlaceRelation::kIn:
      return place.kind == ThingKind::kRoom ? Relation::kOn : Relation::kIn;  // on its floor
    case PlaceRelation::kUnder:
      return Relation::kUnder;
    case PlaceRelation::kAt:
      return Relation::kOn;
    default:
      return std::nullopt;
  }
}

/// Over the middle of the place: on its highest box, in its middle, or on the floor under it.
Pose poseAt(const Thing& place, Relation relation) {
  Eigen::Vector3d at_map = place.middle_map();
  for (const Box& box : place.boxes_map()) {
    if (relation == Relation::kOn) {
      at_map.z() = std::max(at_map.z(), box.center.position_m.z() + box.size_m.z() / 2.0);
    }
  }
  if (relation == Relation::kUnder || place.kind == ThingKind::kRoom) {
    at_map.z() = 0.0;
  }
  return {place.T_map_thing().inverse() * at_map, Eigen::Vector3d::Zero()};
}

class StatementReader {
 public:
  StatementReader(const HomeIndex& index, Words words) : resolver_(index, index, std::nullopt), words_(words) {}

  StatementReading read() {
    const auto parts = split(words_);
    if (!parts) {
      reading_.sentence = "I did not understand that; say for instance 'the blue cup is in the bathroom'.";
      return std::move(reading_);
    }
    if (const Thing* subject = only(readThingPhrase(parts->subject))) {
      if (const auto relation = findRelationWords(parts->predicate); relation && relation->count < parts->predicate.size()) {
        place(*subject, relation->relation, readThingPhrase(parts->predicate.subspan(relation->count)));
      } else {
        state(*subject, parts->predicate);
      }
    }
    return std::move(reading_);
  }

 private:
  /// Null: none or several fit, and the sentence says so.
  const Thing* only(const ThingPhrase& phrase) {
    const Resolution meant = resolver_.resolve(phrase);
    if (meant.things.size() == 1 && meant.known) {
      return meant.things.front();
    }
    reading_.sentence = !meant.known ? "Nothing in this home is called '" + joined(meant.unknown, "', '") + "'."
                        : meant.things.empty()
                            ? "I know of no " + phrase.said + "."
                            : std::to_string(meant.things.size()) + " things fit '" + phrase.said +
                                  "': " + listOf(meant.things, [](const Thing& t) { return theName(t) + " " + placeText(t); }) + ".";
    return nullptr;
  }

  void place(const Thing& subject, PlaceRelation said, const ThingPhrase& where) {
    if (subject.kind != ThingKind::kSmallObject) {
      reading_.sentence = "Only of small objects a person can say where they are.";
      return;
    }
    const Thing* there = only(where);
    const auto relation = there == nullptr ? std::nullopt : relationFor(said, *there);
    const bool carries =
        there != nullptr && (there->kind == ThingKind::kRoom || there->kind == ThingKind::kLargeObject || there->kind == ThingKind::kPart);
    if (!relation || !carries) {
      reading_.sentence = there == nullptr ? reading_.sentence : "I understand on, in and under furniture, its parts and rooms.";
      return;
    }
    reading_.correction = Correction{subject.id(), Placement{there->id(), *relation, poseAt(*there, *relation)}};
    reading_.sentence = "Noted: " + theName(subject) + " is " +
                        (there->kind == ThingKind::kRoom ? "in" : std::string(base::toString(*relation))) + " " + theName(*there) + ".";
  }

  void state(const Thing& subject, Words predicate) {
    if (predicate.size() == 1 && opennessOf(predicate.front()) == false) {
      return close(subject);
    }
    if (predicate.size() > 2 && isOneOf(predicate[0], {"set", "turned", "switched"})) {
      predicate = predicate.subspan(2);
    }
    const std::vector<std::string> asked(predicate.begin(), predicate.end());
    for (const Knob* knob : knobsOf(subject)) {
      for (const KnobState& known : knob->states) {
        if (wordsOf(known.name) == asked) {
          reading_.correction = Correction{knob->id.value, KnobSetting{known.name}};
          reading_.sentence = "Noted: " + theName(subject) + " is set to " + known.name + ".";
          return;
        }
      }
    }
    reading_.sentence = "I did not understand what the " + subject.name() + " is.";
  }

  void close(const Thing& subject) {
    const std::vector<const Joint*> joints = jointsOf(subject);
    if (joints.size() != 1) {
      reading_.sentence = joints.empty() ? "I know of no way to close it." : "Say which of its parts.";
      return;
    }
    const Joint& joint = *joints.front();
    const double shut = std::clamp(0.0, std::min(joint.lower, joint.upper), std::max(joint.lower, joint.upper));
    reading_.correction = Correction{joint.id.value, JointValue{joint.type, shut}};
    reading_.sentence = "Noted: " + theName(subject) + " is closed.";
  }

  Resolver resolver_;
  Words words_;
  StatementReading reading_;
};

}  // namespace

StatementReading readStatement(const HomeIndex& index, std::string_view statement) {
  const std::vector<std::string> words = statement.size() > kMostQuestionBytes ? std::vector<std::string>() : wordsOf(statement);
  if (words.empty() || words.size() > kMostWords) {
    return {std::nullopt, "A statement has at least one word and at most " + std::to_string(kMostWords) + "."};
  }
  const std::vector<std::string> joined_names = index.words().joinNames(words);
  return StatementReader(index, joined_names).read();
}

}  // namespace oikos::semantic
