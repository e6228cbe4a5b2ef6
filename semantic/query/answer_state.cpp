// SPDX-License-Identifier: Apache-2.0
// Answers about states: what is open, and how far; what a knob is set to.
#include <algorithm>
#include <iterator>
#include <set>

#include "core/base/number_text.h"
#include "semantic/query/answer_context.h"
#include "semantic/query/sentence.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

std::string knobText(const Knob& knob, const Thing& thing) {
  Thing named = thing;
  named.kind = ThingKind::kKnob;
  named.knob = &knob;
  return theName(named);
}

std::string stateSentence(const AnswerContext& ctx, const Thing& thing) {
  const bool several = jointsOf(thing).size() > 1;
  return theName(thing) + (several ? ": " : " " + ctx.be(thing) + " ") + stateText(thing);
}

/// Of a knob's states, the one in which nothing runs.
bool isOffState(const std::string& name) {
  return name == "off" || name == "0";
}

/// Whether all words of the state that was asked for are in the knob's state, or nothing: the knob cannot be so at all.
std::optional<bool> isSetTo(const Knob& knob, const std::string& state) {
  if (state == "on" || state == "running") {
    return !isOffState(knob.current);
  }
  const std::vector<std::string> asked = wordsOf(state);
  const auto fits = [&](const std::string& name) {
    const std::vector<std::string> words = wordsOf(name);
    return (state == "off" && isOffState(name)) || std::all_of(asked.begin(), asked.end(), [&](const std::string& word) {
             return std::find(words.begin(), words.end(), word) != words.end();
           });
  };
  const bool can_be = std::any_of(knob.states.begin(), knob.states.end(), [&](const KnobState& s) { return fits(s.name); });
  return can_be ? std::optional(fits(knob.current)) : std::nullopt;
}

/// When a joint of the thing was open within the time asked for, though not at its end.
std::optional<std::int64_t> openedWithin(const AnswerContext& ctx, const Thing& thing) {
  if (ctx.history() == nullptr || !ctx.span() || ctx.span()->from_ns == ctx.span()->to_ns) {
    return std::nullopt;
  }
  for (const Joint* joint : jointsOf(thing)) {
    for (const Event& event : ctx.history()->eventsOf(joint->id.value)) {
      const auto* value = event.after ? std::get_if<JointValue>(&*event.after) : nullptr;
      Joint then = *joint;
      then.value = value == nullptr ? 0.0 : value->value;
      if (value != nullptr && event.time_ns >= ctx.span()->from_ns && event.time_ns < ctx.span()->to_ns && isOpen(then)) {
        return event.time_ns;
      }
    }
  }
  return std::nullopt;
}

struct KnobSeen {
  const Thing* thing = nullptr;
  const Knob* knob = nullptr;
  bool is_so = false;
};

/// Of a yes those that are so, of a no those that are not; where that is none, all.
template <class Fits>
Things thoseThatTell(const Things& things, const Fits& fits, bool yes) {
  Things telling;
  std::copy_if(things.begin(), things.end(), std::back_inserter(telling), [&](const Thing* thing) { return fits(thing) == yes; });
  return telling.empty() ? things : telling;
}

void answerIsOpen(AnswerContext& ctx) {
  const auto movable = ctx.takeOpenable();
  if (!movable) {
    return;
  }
  const bool open = ctx.question().state == "open";
  const auto fits = [&](const Thing* thing) { return *isOpen(*thing) == open; };
  const auto so = static_cast<std::size_t>(std::count_if(movable->begin(), movable->end(), fits));
  if (so == movable->size() || (so > 0 && ctx.question().any)) {
    ctx.answer.yes = true;
  } else if (so == 0 || ctx.question().all) {  // else: which one was meant cannot be told
    ctx.answer.yes = false;
  }
  const Things telling = ctx.answer.yes ? thoseThatTell(*movable, fits, *ctx.answer.yes) : *movable;
  ctx.take(telling);
  std::string sentence = listOf(telling, [&](const Thing& thing) { return stateSentence(ctx, thing); });
  if (const auto opened_ns =
          open && ctx.answer.yes == false && movable->size() == 1 ? openedWithin(ctx, *movable->front()) : std::nullopt) {
    ctx.answer.yes = true;
    sentence += " at the end, but it was open " + ctx.clock().text(*opened_ns);
  }
  const std::string verdict = !ctx.answer.yes ? "" : *ctx.answer.yes ? "yes: " : "no: ";
  ctx.say(verdict + sentence + ".");
}

}  // namespace

void answerIsState(AnswerContext& ctx) {
  if (ctx.question().state == "open" || ctx.question().state == "closed") {
    return answerIsOpen(ctx);
  }
  const auto things = ctx.resolveSome();
  if (!things) {
    return;
  }
  std::vector<KnobSeen> knobs;
  for (const Thing* thing : *things) {
    for (const Knob* knob : knobsOf(*thing)) {
      if (const auto is_so = isSetTo(*knob, ctx.question().state)) {
        knobs.push_back({thing, knob, *is_so});
      }
    }
  }
  if (knobs.empty()) {
    return ctx.nothingFits("I know of nothing that would set the " + ctx.question().thing.said + " to '" + ctx.question().state + "'.");
  }
  // "on": one knob of the oven will do; anything else asks for all.
  const bool any_will_do = ctx.question().any || ctx.question().state == "on" || ctx.question().state == "running";
  const auto is_so = [](const KnobSeen& seen) { return seen.is_so; };
  const bool yes = any_will_do ? std::any_of(knobs.begin(), knobs.end(), is_so) : std::all_of(knobs.begin(), knobs.end(), is_so);
  std::erase_if(knobs, [&](const KnobSeen& seen) { return seen.is_so != yes; });  // those that tell
  Things telling;
  std::vector<std::string> texts;
  for (const KnobSeen& seen : knobs) {
    telling.push_back(seen.thing);
    texts.push_back(knobText(*seen.knob, *seen.thing) + " " + ctx.be(1) + " set to " + seen.knob->current);
  }
  ctx.take(telling);
  ctx.answer.yes = yes;
  ctx.say((yes ? "yes: " : "no: ") + enumerated(texts) + ".");
}

/// Drops a piece all of whose doors and drawers are things by themselves: "which drawers" is not of the chest.
void keepParts(Things& things) {
  std::set<const Joint*> of_parts;
  for (const Thing* thing : things) {
    if (thing->kind == ThingKind::kPart && jointsOf(*thing).size() == 1) {
      of_parts.insert(jointsOf(*thing).front());
    }
  }
  std::erase_if(things, [&](const Thing* thing) {
    const std::vector<const Joint*> joints = jointsOf(*thing);
    return thing->kind != ThingKind::kPart && !joints.empty() &&
           std::all_of(joints.begin(), joints.end(), [&](const Joint* joint) { return of_parts.contains(joint); });
  });
}

void answerWhichState(AnswerContext& ctx) {
  auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  keepParts(*things);
  const std::string& state = ctx.question().state;
  Things fitting;
  bool any_has_it = false;
  const bool is_opening = state == "open" || state == "closed";
  for (const Thing* thing : *things) {
    bool fits = false;
    if (is_opening) {
      const auto open = isOpen(*thing);
      any_has_it = any_has_it || open.has_value();
      fits = open && *open == (state == "open");
    } else {
      for (const Knob* knob : knobsOf(*thing)) {
        const auto is_so = isSetTo(*knob, state);
        any_has_it = any_has_it || is_so.has_value();
        fits = fits || is_so.value_or(false);
      }
    }
    if (fits) {
      fitting.push_back(thing);
    }
  }
  if (!any_has_it) {
    return ctx.nothingFits(things->empty() ? "" : "I know of none that could be " + state + ".");
  }
  ctx.take(fitting);
  ctx.say(fitting.empty() ? "none." : listOf(fitting, [&](const Thing& thing) {
                                        return is_opening ? stateSentence(ctx, thing) : theName(thing) + " " + ctx.be(thing) + " " + state;
                                      }) + ".");
}

void answerHowFar(AnswerContext& ctx) {
  const auto movable = ctx.takeOpenable();
  if (!movable) {
    return;
  }
  ctx.say(listOf(*movable, [&](const Thing& thing) { return stateSentence(ctx, thing); }) + ".");
}

void answerSetting(AnswerContext& ctx) {
  const auto things = ctx.resolveThing();
  if (!things) {
    return;
  }
  Things knobs;
  for (const Thing* thing : *things) {
    for (const Knob* knob : knobsOf(*thing)) {
      const Thing* found = ctx.index().findById(knob->id.value);
      if (found != nullptr && std::find(knobs.begin(), knobs.end(), found) == knobs.end()) {
        knobs.push_back(found);
      }
    }
  }
  if (knobs.empty()) {
    return ctx.nothingFits(things->empty() ? "" : "The " + ctx.question().thing.said + " has nothing that could be set.");
  }
  ctx.take(knobs);
  ctx.say(listOf(knobs, [&](const Thing& thing) { return theName(thing) + " " + ctx.be(1) + " set to " + thing.knob->current; }) + ".");
}

}  // namespace oikos::semantic
