// SPDX-License-Identifier: Apache-2.0
// Answers about doing: where to stand, how to open and grasp, what for, and the plan to fetch something.
#include <algorithm>

#include "core/base/number_text.h"
#include "semantic/query/answer_context.h"
#include "semantic/query/grammar_words.h"
#include "semantic/query/sentence.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

std::string nameOfPart(const LargeObject& object, const PartId& id) {
  const auto& parts = object.articulation->parts;
  const auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.id == id; });
  return part == parts.end() ? id.value : partName(object, *part);
}

std::string carrierText(const Thing& thing) {
  if (thing.object == nullptr) {
    return "the " + thing.room->name;
  }
  if (thing.kind == ThingKind::kSmallObject) {
    return theName(Thing{ThingKind::kLargeObject, thing.room, thing.object, nullptr, nullptr, nullptr});
  }
  return theName(thing);
}

PlanStep goTo(const FoundThing& found, const Thing& thing) {
  const std::string& id = thing.object == nullptr ? found.room : thing.object->id.value;
  const std::string where =
      found.T_map_base.empty() ? " (no place to stand is known)" : ": stand at " + standText(found.T_map_base.front());
  return {StepKind::kGoTo, id, found.T_map_base, "go to " + carrierText(thing) + where};
}

PlanStep openStep(const LargeObject& object, const Joint& joint) {
  PlanStep step{StepKind::kOpen, joint.id.value, {}, ""};
  const bool turns = joint.type == JointType::kRevolute;
  step.text = "open the " + nameOfPart(object, joint.child);
  const std::vector<HandlePlace> handles = handlesOf(object, joint);
  for (const HandlePlace& handle : handles) {
    step.T_map.push_back(handle.T_map_handle);
  }
  if (handles.empty()) {
    step.text += " (no handle is known)";
  } else {
    const Eigen::Vector3d at_map = handles.front().T_map_handle.translation();
    step.text += " by its " + std::string(base::toString(handles.front().kind)) + " handle at " + positionText(at_map) + ", " +
                 base::toFixedText(at_map.z(), 2) + " m high";
  }
  const double way = std::abs(joint.upper - joint.lower);
  step.text += turns ? ", which turns by up to " + base::toFixedText(way / kRadPerDeg, 0) + " degrees"
                     : ", which slides out by up to " + base::toFixedText(way * 100.0, 0) + " cm";
  return step;
}

std::string stepsText(const std::vector<PlanStep>& steps) {
  std::vector<std::string> texts;
  for (const PlanStep& step : steps) {
    texts.push_back(step.text);
  }
  return joined(texts, "; then ");
}

void sayUses(AnswerContext& ctx, const Thing& thing) {
  const Vocabulary& vocabulary = ctx.index().home().vocabulary;
  std::vector<std::string> uses;
  for (const std::string& affordance : thing.object->affordances) {
    const Term* term = vocabulary.find(TermKind::kAffordance, affordance);
    uses.push_back(term == nullptr || term->synonyms.empty() ? spaced(affordance) : term->synonyms.front());
  }
  ctx.say(uses.empty() ? "nothing is known of what " + theName(thing) + " is for."
                       : theName(thing) + " can be used to: " + joined(uses, ", ") + ".");
}

/// The affordance that the words name; null: none.
const Term* affordanceOf(const Vocabulary& vocabulary, const std::vector<std::string>& words) {
  std::vector<std::string> plain = words;
  std::erase_if(plain, [](const std::string& word) { return isFiller(word) || word == "something" || word == "things" || word == "to"; });
  const std::string asked = joined(plain, " ");
  for (const Term& term : vocabulary.affordances) {
    std::vector<std::string> phrases = term.synonyms;
    phrases.push_back(spaced(term.name));
    for (const std::string& phrase : phrases) {
      std::vector<std::string> known = wordsOf(phrase);
      std::erase_if(known, [](const std::string& word) { return word == "things"; });
      if (joined(known, " ") == asked) {
        return &term;
      }
    }
  }
  return nullptr;
}

/// The nearest to the robot first, then what is graspable.
void orderForFetching(const AnswerContext& ctx, Things& things) {
  std::stable_sort(things.begin(), things.end(), [&](const Thing* a, const Thing* b) {
    const auto graspable = [](const Thing* t) { return t->kind == ThingKind::kSmallObject && t->small_object->graspable; };
    if (graspable(a) != graspable(b)) {
      return graspable(a);
    }
    const auto distance = [&](const Thing* t) { return (t->middle_map().head<2>() - ctx.robot()->position_map_m).norm(); };
    return ctx.robot() && distance(a) < distance(b);
  });
}

/// Where it may be: as it is said to lie now, and at its usual places.
struct Candidate {
  SmallObject small;
  double probability = 0.0;
};

/// S95-S99: where it was last, then its usual places; what is believed to be likelier comes first.
std::vector<Candidate> candidatesFor(const AnswerContext& ctx, const SmallObject& small) {
  const FoundThing& found = ctx.answer.found.front();
  const auto probabilityOf = [&](const Place& place) {
    const auto known = std::find_if(found.expected_at.begin(), found.expected_at.end(), [&](const auto& p) { return p.place == place; });
    return known == found.expected_at.end() ? 0.0 : known->probability;
  };
  std::vector<Candidate> candidates{{small, probabilityOf({small.parent, small.relation})}};
  for (const Placement& placement : small.default_places) {
    const Thing* const parent = ctx.index().findById(placement.parent);
    if (placement.parent == small.parent || parent == nullptr || parent->object == nullptr) {
      continue;
    }
    SmallObject moved = small;
    moved.parent = placement.parent;
    moved.relation = placement.relation;
    moved.T_parent_object = placement.T_parent_object;
    candidates.push_back({std::move(moved), probabilityOf({placement.parent, placement.relation})});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.probability > b.probability; });
  return candidates;
}

/// Go, open, look; returns the thing's description there.
FoundThing addLook(AnswerContext& ctx, const Thing& there, std::string_view condition) {
  FoundThing found = describe(there, ctx.robot());
  PlanStep go = goTo(found, there);
  go.text.insert(0, condition);
  ctx.answer.steps.push_back(std::move(go));
  for (const Joint* joint : jointsInTheWay(there)) {
    ctx.answer.steps.push_back(openStep(*there.object, *joint));
  }
  ctx.answer.steps.push_back({StepKind::kLook, there.id(), {there.T_map_thing()}, "look for " + theName(there) + " " + placeText(there)});
  return found;
}

/// `small`: the thing where it may be.
Thing thingAt(const AnswerContext& ctx, const Thing& thing, const SmallObject& small) {
  Thing there = thing;
  there.small_object = &small;
  if (small.parent != thing.small_object->parent) {
    const Thing& parent = *ctx.index().findById(small.parent);
    there.room = parent.room;
    there.object = parent.object;
    there.part = parent.part;
  }
  return there;
}

}  // namespace

void answerStand(AnswerContext& ctx) {
  const auto things = ctx.resolveSome();
  if (!things) {
    return;
  }
  ctx.take(*things);
  Things with_place;
  std::copy_if(things->begin(), things->end(), std::back_inserter(with_place),
               [](const Thing* thing) { return thing->object != nullptr && !thing->object->parking_poses.empty(); });
  if (with_place.empty()) {
    ctx.answer.found.clear();
    return ctx.nothingFits("I know of no place to stand for the " + ctx.question().thing.said + ".");
  }
  ctx.say(listOf(with_place,
                 [&](const Thing& thing) {
                   const FoundThing found = describe(thing, ctx.robot());
                   std::vector<std::string> stands;
                   for (const Eigen::Isometry3d& T_map_base : found.T_map_base) {
                     stands.push_back(standText(T_map_base));
                   }
                   return "for " + theName(thing) + (thing.kind == ThingKind::kSmallObject ? " " + placeText(thing) : "") + " stand at " +
                          joined(stands, ", or ");
                 }) +
          ".");
}

void answerHowOpen(AnswerContext& ctx) {
  const auto movable = ctx.takeOpenable();
  if (!movable) {
    return;
  }
  for (const Thing* thing : *movable) {
    ctx.answer.steps.push_back(goTo(describe(*thing, ctx.robot()), *thing));
    for (const Joint* joint : jointsOf(*thing)) {
      ctx.answer.steps.push_back(openStep(*thing->object, *joint));
    }
  }
  ctx.say(stepsText(ctx.answer.steps) + ".");
}

void answerHowGrasp(AnswerContext& ctx) {
  const auto things = ctx.resolveSome();
  if (!things) {
    return;
  }
  ctx.take(*things);
  ctx.say(listOf(*things,
                 [&](const Thing& thing) {
                   const FoundThing found = describe(thing);
                   const bool graspable = thing.kind == ThingKind::kSmallObject ? thing.small_object->graspable
                                          : thing.object != nullptr             ? thing.object->graspable || thing.kind == ThingKind::kPart
                                                                                : false;
                   if (!graspable || found.T_map_grasp.empty()) {
                     return theName(thing) + (!graspable        ? " cannot be grasped"
                                              : isPlural(thing) ? " have no known grasping point"
                                                                : " has no known grasping point");
                   }
                   const Eigen::Vector3d at_map = found.T_map_grasp.front().translation();
                   return "grasp " + theName(thing) + " " + placeText(thing) + " at " + positionText(at_map) + ", " +
                          base::toFixedText(at_map.z(), 2) + " m high";
                 }) +
          ".");
}

void answerUse(AnswerContext& ctx) {
  const auto has_uses = [](const Thing& thing) { return thing.kind == ThingKind::kLargeObject && !thing.object->affordances.empty(); };
  const auto usable = ctx.takeThose(has_uses, "I do not know what the " + ctx.question().thing.said + " can be used for.");
  if (usable) {
    sayUses(ctx, *usable->front());
  }
}

void answerWhatFor(AnswerContext& ctx) {
  const Term* term = affordanceOf(ctx.index().home().vocabulary, ctx.question().use);
  if (term == nullptr) {
    ctx.answer.status = AnswerStatus::kNotUnderstood;
    ctx.answer.not_understood = ctx.question().use;
    return ctx.say("I know of no use called '" + joined(ctx.question().use, " ") + "'.");
  }
  Things things;
  for (std::uint32_t i = 0; i < ctx.index().size(); ++i) {
    const Thing& thing = ctx.index().thing(i);
    if (thing.kind == ThingKind::kLargeObject) {
      const auto& affordances = thing.object->affordances;
      if (std::find(affordances.begin(), affordances.end(), term->name) != affordances.end()) {
        things.push_back(&thing);
      }
    }
  }
  if (things.empty()) {
    return ctx.nothingFits("I know of nothing to " + joined(ctx.question().use, " ") + ".");
  }
  ctx.take(things);
  ctx.say(listOf(things, [](const Thing& thing) { return theName(thing) + " " + placeText(thing); }) + ".");
}

void answerFetch(AnswerContext& ctx) {
  auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  std::erase_if(*things, [](const Thing* thing) { return thing->kind == ThingKind::kRoom || thing->kind == ThingKind::kKnob; });
  if (things->empty()) {
    return ctx.nothingFits();
  }
  orderForFetching(ctx, *things);
  ctx.take(*things);
  const Thing& thing = *things->front();
  if (thing.kind != ThingKind::kSmallObject || !thing.small_object->graspable) {
    return ctx.say(theName(thing) + " " + ctx.be(thing) + " " + placeText(thing) + ", but cannot be carried.");
  }
  const std::vector<Candidate> candidates = candidatesFor(ctx, *thing.small_object);
  const FoundThing first = addLook(ctx, thingAt(ctx, thing, candidates.front().small), "");
  ctx.answer.steps.push_back({StepKind::kGrasp, thing.id(), first.T_map_grasp, "grasp it"});
  const std::string plan = stepsText(ctx.answer.steps);
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    (void)addLook(ctx, thingAt(ctx, thing, candidates[i].small), "if it is not there, ");
  }
  ctx.say(plan + "." + (things->size() > 1 ? " " + std::to_string(things->size() - 1) + " more would fit." : ""));
}

}  // namespace oikos::semantic
