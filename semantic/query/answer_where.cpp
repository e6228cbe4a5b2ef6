// SPDX-License-Identifier: Apache-2.0
// Answers about places: where, what is there, how many, whether, how far from each other.
#include <algorithm>

#include "core/base/number_text.h"
#include "semantic/query/answer_context.h"
#include "semantic/query/sentence.h"

namespace oikos::semantic {

namespace {

std::string nameAndPlace(const Thing& thing) {
  return thing.kind == ThingKind::kRoom ? theName(thing) : theName(thing) + " " + placeText(thing);
}

std::string placeSaid(const PlacePhrase& place) {
  return std::string(base::toString(place.relation)) + " the " + place.thing.said;
}

/// How the question called the places.
std::string placesSaid(const ThingPhrase& phrase) {
  std::string text;
  for (const PlacePhrase& place : phrase.places) {
    text += (place.negated ? " not " : " ") + placeSaid(place);
    for (const PlacePhrase& other : place.or_at) {
      text += other.thing.said == place.thing.said ? "" : " or " + placeSaid(other);
    }
  }
  return text;
}

/// Nothing there, though the place is known and the thing is known elsewhere, or anything would do.
bool isKnownAbsence(const AnswerContext& ctx) {
  const bool anything = ctx.question().thing.words.empty() && ctx.question().thing.whole.empty();
  return ctx.resolution().missing_place.empty() && (ctx.resolution().elsewhere > 0 || anything);
}

std::string placementText(const AnswerContext& ctx, const Placement& placement) {
  const Thing* parent = ctx.index().findById(placement.parent);
  if (parent == nullptr) {
    return {};
  }
  if (parent->kind == ThingKind::kRoom) {
    return "in the " + parent->name();
  }
  Thing carrier = *parent;
  if (carrier.kind == ThingKind::kPart && carrier.part->parent.value.empty()) {
    carrier.kind = ThingKind::kLargeObject;
  }
  return std::string(base::toString(placement.relation)) + " the " + carrier.name();
}

/// Empty: it is not known.
std::string propertyOf(const Thing& thing, const std::string& name) {
  if (thing.kind == ThingKind::kSmallObject) {
    const auto& properties = thing.small_object->properties;
    const auto found = std::find_if(properties.begin(), properties.end(), [&](const Property& p) { return p.name == name; });
    if (found != properties.end() && !found->value.empty()) {
      return spaced(found->value);
    }
  }
  if (name != "type" && name != "kind") {
    return {};
  }
  return spaced(thing.kind == ThingKind::kSmallObject ? thing.small_object->type
                : thing.object != nullptr             ? thing.object->type
                                                      : thing.room->type);
}

/// That a found thing was not there when it was looked for; empty: it was not missed.
std::string missedText(const AnswerContext& ctx, const FoundThing& found) {
  return found.missed_ns ? "looked for there in vain " + ctx.clock().text(*found.missed_ns) : "";
}

/// Of several things that were taken into the answer, where each is, and which of them was missed.
std::string placesOf(const AnswerContext& ctx, const Things& things) {
  return listOf(things, [&](const Thing& thing) {
    const auto number = static_cast<std::size_t>(std::find(things.begin(), things.end(), &thing) - things.begin());
    const std::string missed = missedText(ctx, ctx.answer.found.at(number));
    return nameAndPlace(thing) + (missed.empty() ? "" : " (" + missed + ")");
  });
}

/// Where the only found thing is likelier than where it was last; empty: nowhere.
std::string likelierText(const AnswerContext& ctx) {
  const FoundThing& found = ctx.answer.found.front();
  if (found.expected_at.empty() || found.expected_at.front().probability <= found.confidence.value_or(1.0)) {
    return {};
  }
  const auto& [place, probability] = found.expected_at.front();
  const std::string text = placementText(ctx, {place.parent, place.relation, {}});
  return text.empty() ? "" : (ctx.answer.at_ns ? ", more likely " : ", by now more likely ") + text;
}

}  // namespace

void answerWhere(AnswerContext& ctx) {
  const auto things = ctx.resolveSome();
  if (!things) {
    return;
  }
  ctx.take(*things);
  if (things->size() > 1) {
    return ctx.say(std::to_string(things->size()) + " things fit: " + placesOf(ctx, *things) + ".");
  }
  const Thing& thing = *things->front();
  std::string sentence = theName(thing) + " " + ctx.be(thing) + " " + placeText(thing);
  if (thing.kind == ThingKind::kSmallObject && thing.small_object->last_seen_ns && !ctx.answer.at_ns) {
    sentence += ", last seen " + ctx.clock().text(*thing.small_object->last_seen_ns);
  }
  const std::string missed = missedText(ctx, ctx.answer.found.front());
  ctx.say(sentence + (missed.empty() ? "" : ", but was " + missed) + likelierText(ctx) + ".");
}

void answerUsualPlace(AnswerContext& ctx) {
  const auto has_place = [](const Thing& thing) {
    return thing.kind == ThingKind::kSmallObject && !thing.small_object->default_places.empty();
  };
  const auto placed = ctx.takeThose(has_place, "I do not know where it belongs.");
  if (!placed) {
    return;
  }
  std::vector<std::string> texts;
  for (const Thing* thing : *placed) {
    std::vector<std::string> places;
    for (const Placement& placement : thing->small_object->default_places) {
      places.push_back(placementText(ctx, placement));
    }
    texts.push_back(theName(*thing) + (isPlural(*thing) ? " belong " : " belongs ") + joined(places, " or "));
  }
  ctx.say(enumerated(texts) + ".");
}

void answerContents(AnswerContext& ctx) {
  const auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  if (things->empty()) {
    if (!ctx.resolution().missing_place.empty()) {
      return ctx.nothingFits();
    }
    const std::string what =
        ctx.question().thing.words.empty() ? "nothing" + placesSaid(ctx.question().thing) : "no " + ctx.question().thing.said;
    return ctx.nothingFits("I know of " + what + ".");
  }
  ctx.take(*things);
  ctx.say(listOf(*things, theName) + " " + (things->size() == 1 ? ctx.be(*things->front()) : ctx.be(things->size())) +
          placesSaid(ctx.question().thing) + ".");
}

void answerCount(AnswerContext& ctx) {
  const auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  if (things->empty() && !isKnownAbsence(ctx)) {
    ctx.nothingFits();
  } else {
    ctx.take(*things);
    ctx.say(things->empty() ? "none" + placesSaid(ctx.question().thing) + "."
                            : std::to_string(things->size()) + ": " + listOf(*things, nameAndPlace) + ".");
  }
  ctx.answer.count = things->size();
}

namespace {

/// Whether something of each noun is there: "a knife and a fork".
bool isThereOfEach(const AnswerContext& ctx, const ThingPhrase& thing) {
  if (thing.either || thing.others.empty()) {
    return true;
  }
  ThingPhrase first = thing;
  first.others.clear();
  return !ctx.resolve(first).things.empty() && std::all_of(thing.others.begin(), thing.others.end(), [&](const ThingPhrase& other) {
    return !ctx.resolve(other).things.empty() && isThereOfEach(ctx, other);
  });
}

void clearPlaces(ThingPhrase& thing) {
  thing.places.clear();
  std::for_each(thing.others.begin(), thing.others.end(), clearPlaces);
}

/// Those that are called so but are not among the things at the question's places.
Things missingOf(const AnswerContext& ctx, const Things& there) {
  ThingPhrase anywhere = ctx.question().thing;
  clearPlaces(anywhere);
  if (anywhere.words.empty() || ctx.question().thing.places.empty()) {
    return {};
  }
  Things others = ctx.resolve(anywhere).things;
  std::erase_if(others, [&](const Thing* thing) { return std::find(there.begin(), there.end(), thing) != there.end(); });
  return others;
}

}  // namespace

void answerIsThere(AnswerContext& ctx) {
  const auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  if (things->empty() && !isKnownAbsence(ctx)) {
    return ctx.nothingFits();
  }
  ctx.take(*things);
  const Things elsewhere = missingOf(ctx, *things);
  ctx.answer.yes = !things->empty() && isThereOfEach(ctx, ctx.question().thing) && (elsewhere.empty() || !ctx.question().all);
  const auto is_there = [&](const Thing& thing) { return theName(thing) + " " + ctx.be(thing) + " " + placeText(thing); };
  if (*ctx.answer.yes) {
    return ctx.say("yes: " + listOf(*things, is_there) + ".");
  }
  if (!things->empty() && !ctx.question().all) {
    return ctx.say("only " + listOf(*things, nameAndPlace) + ".");
  }
  ctx.say((things->empty() ? "not that I know" : "not all") + (elsewhere.empty() ? "" : ": " + listOf(elsewhere, is_there)) + ".");
}

void answerProperty(AnswerContext& ctx) {
  const std::string& asked = ctx.question().property;
  const auto known =
      ctx.takeThose([&](const Thing& thing) { return !propertyOf(thing, asked).empty(); }, "I do not know its " + asked + ".");
  if (!known) {
    return;
  }
  std::vector<std::string> texts;
  for (const Thing* thing : *known) {
    const std::string verb = asked == "content" ? (isPlural(*thing) ? "contain" : "contains") : ctx.be(*thing);
    texts.push_back(theName(*thing) + " " + verb + " " + propertyOf(*thing, asked));
  }
  ctx.say(enumerated(texts) + ".");
}

void answerDistance(AnswerContext& ctx) {
  const auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  const Resolution others = ctx.resolve(*ctx.question().other);
  if (things->empty() || others.things.empty()) {
    return ctx.nothingFits(things->empty() ? "" : "I know of no " + ctx.question().other->said + ".");
  }
  const Thing& other = *others.things.front();
  ctx.take(*things);
  ctx.say(listOf(*things,
                 [&](const Thing& thing) {
                   return theName(thing) + " " + ctx.be(thing) + " " + base::toFixedText(distanceBetween(thing, other), 2) + " m from " +
                          theName(other);
                 }) +
          ".");
}

}  // namespace oikos::semantic
