// SPDX-License-Identifier: Apache-2.0
// Answers from the log: when, what changed, the history of a thing.
#include <algorithm>
#include <limits>
#include <set>

#include "semantic/query/answer_context.h"
#include "semantic/query/event_text.h"
#include "semantic/query/sentence.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kMostChanges = 20;
constexpr std::size_t kMostTold = 8;

std::optional<State> stateBefore(const History& history, const Event& event) {
  if (event.before) {
    return event.before;
  }
  const auto earlier = history.findStateAt(event.subject, event.time_ns - 1);
  return earlier ? earlier->after : std::nullopt;
}

/// Whether something was different after it.
bool isChange(const History& history, const Event& event) {
  if (!event.after || event.kind == EventKind::kMissed || event.kind == EventKind::kForgotten) {
    return false;
  }
  const auto before = stateBefore(history, event);
  return !before || EventTeller::isChange(*before, *event.after);
}

/// Whether it is news that the thing was not where it was expected: a miss changes no state, but a person wants to hear of the first.
bool isFirstMiss(const History& history, const Event& event) {
  if (event.kind != EventKind::kMissed) {
    return false;
  }
  const std::vector<Event> earlier = history.lastEventsOf(event.subject, event.time_ns - 1, 1);
  return earlier.empty() || earlier.back().kind != EventKind::kMissed || earlier.back().after != event.after;
}

/// Whether a change led to the state that was asked for, "open" or "closed"; empty: any will do.
bool ledTo(const std::string& state, const History& history, EventTeller& teller, const Event& event) {
  if (state.empty()) {
    return true;
  }
  const auto before = stateBefore(history, event);
  const bool open = state == "open";
  return teller.isOpenIn(event.subject, *event.after) == open && (!before || teller.isOpenIn(event.subject, *before) != open);
}

std::string eventText(EventTeller& teller, const Event& event, const HomeClock& clock) {
  const std::string when = clock.text(event.time_ns);
  if (event.kind == EventKind::kMissed) {
    return when + " not where it was expected";
  }
  const std::string what = event.after ? teller.stateText(event.subject, *event.after) : std::string(base::toString(event.kind));
  return when + " " + what + (event.kind == EventKind::kCorrected ? " (as a person said)" : "");
}

/// All events of the things, by time.
std::vector<Event> eventsOf(const History& history, const Things& things) {
  std::vector<Event> events;
  std::set<std::string> subjects;
  for (const Thing* thing : things) {
    for (const std::string& subject : EventTeller::subjectsOf(*thing)) {
      if (subjects.insert(subject).second) {
        const std::vector<Event> more = history.eventsOf(subject);
        events.insert(events.end(), more.begin(), more.end());
      }
    }
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.time_ns < b.time_ns; });
  return events;
}

void eraseOutside(std::vector<Event>& events, const std::optional<TimeSpan>& span) {
  if (span) {
    std::erase_if(events, [&](const Event& event) {
      return event.time_ns < span->from_ns || event.time_ns >= std::max(span->to_ns, span->from_ns + 1);
    });
  }
}

void noteChanges(AnswerContext& ctx, EventTeller& teller, const std::vector<Event>& events) {
  const std::size_t first = events.size() > kMostChanges ? events.size() - kMostChanges : 0;
  for (std::size_t i = first; i < events.size(); ++i) {
    const Thing* thing = teller.thingOf(events[i].subject);
    const std::string name = thing == nullptr ? events[i].subject : theName(*thing);
    ctx.answer.changes.push_back(
        {events[i], thing == nullptr ? events[i].subject : thing->id(), name + " " + eventText(teller, events[i], ctx.clock())});
  }
}

bool hasHistory(AnswerContext& ctx) {
  if (ctx.history() == nullptr) {
    ctx.nothingFits("This home has no history.");
  }
  return ctx.history() != nullptr;
}

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();

struct Sight {
  std::int64_t seen_ns = kNever;
  std::int64_t missed_ns = kNever;
};

/// Up to now. A joint or knob that was read is furniture that was seen.
Sight lastSight(const AnswerContext& ctx, const Thing& thing) {
  Sight sight;
  if (thing.kind == ThingKind::kSmallObject) {
    sight.seen_ns = thing.small_object->last_seen_ns.value_or(kNever);
  }
  if (ctx.history() == nullptr) {
    return sight;
  }
  for (const Event& event : eventsOf(*ctx.history(), {&thing})) {
    if (event.time_ns > ctx.clock().now_ns()) {
      break;
    }
    if (event.kind == EventKind::kMissed) {
      sight.missed_ns = event.time_ns;
    } else if (event.kind == EventKind::kSighted || event.kind == EventKind::kJoint || event.kind == EventKind::kKnob ||
               event.kind == EventKind::kMoved) {
      sight.seen_ns = std::max(sight.seen_ns, event.time_ns);
    }
  }
  return sight;
}

/// The place that a change led away from, for "what changed in the bedroom".
bool wasThere(const AnswerContext& ctx, const Event& event, const ThingPhrase& phrase) {
  const auto before = stateBefore(*ctx.history(), event);
  const auto* placement = before ? std::get_if<Placement>(&*before) : nullptr;
  const Thing* parent = placement == nullptr ? nullptr : ctx.index().findById(placement->parent);
  if (parent == nullptr || phrase.places.empty()) {
    return false;
  }
  const Resolution places = ctx.resolve(phrase.places.front().thing);
  return std::any_of(places.things.begin(), places.things.end(), [&](const Thing* place) {
    return place == parent || (place->kind == ThingKind::kRoom ? place->room->id == parent->room->id
                                                               : parent->object != nullptr && place->object == parent->object);
  });
}

/// Where things and places of the question leave it.
bool isAskedFor(const AnswerContext& ctx, const Event& event, const Thing* thing, const Things& asked) {
  const ThingPhrase& phrase = ctx.question().thing;
  if (phrase.empty() || phrase.words.empty()) {
    if (phrase.places.empty()) {
      return true;
    }
    const bool is_there = thing != nullptr && std::all_of(phrase.places.begin(), phrase.places.end(), [&](const PlacePhrase& place) {
                            return Resolver::isAt(*thing, place.relation, ctx.resolve(place.thing));
                          });
    return is_there || wasThere(ctx, event, phrase);
  }
  return std::any_of(asked.begin(), asked.end(), [&](const Thing* t) {
    const std::vector<std::string> subjects = EventTeller::subjectsOf(*t);
    return std::find(subjects.begin(), subjects.end(), event.subject) != subjects.end();
  });
}

}  // namespace

void answerLastSeen(AnswerContext& ctx) {
  const auto things = ctx.resolveSome();
  if (!things) {
    return;
  }
  std::vector<std::string> texts;
  Things seen;
  for (const Thing* thing : *things) {
    const Sight sight = lastSight(ctx, *thing);
    if (sight.seen_ns > kNever) {
      const bool in_vain = sight.missed_ns > sight.seen_ns;
      seen.push_back(thing);
      texts.push_back(theName(*thing) + " " + ctx.clock().text(sight.seen_ns) + " " + placeText(*thing) +
                      (in_vain ? ", and looked for it in vain " + ctx.clock().text(sight.missed_ns) : ""));
    }
  }
  if (seen.empty()) {
    return ctx.nothingFits("I do not know when: nothing is recorded.");
  }
  ctx.take(seen);
  ctx.say("I last saw " + enumerated(texts) + ".");
}

void answerLastChange(AnswerContext& ctx) {
  const auto things = ctx.resolveSome();
  if (!things || !hasHistory(ctx)) {
    return;
  }
  EventTeller teller(ctx.index());
  std::vector<Event> events = eventsOf(*ctx.history(), *things);
  eraseOutside(events, ctx.span());
  const std::string& state = ctx.question().state;
  std::erase_if(events,
                [&](const Event& event) { return !isChange(*ctx.history(), event) || !ledTo(state, *ctx.history(), teller, event); });
  if (events.empty() && !ctx.span()) {
    const std::string what = state.empty() ? "change of the " : state == "open" ? "opening of the " : "closing of the ";
    return ctx.nothingFits("I know of no " + what + ctx.question().thing.said + ".");
  }
  ctx.take(*things);
  ctx.answer.yes = !events.empty();
  noteChanges(ctx, teller, events);
  if (events.empty()) {
    return ctx.say("not that I know.");
  }
  const Thing* thing = teller.thingOf(events.back().subject);
  ctx.say("the last change: " + (thing == nullptr ? "" : theName(*thing) + " ") + eventText(teller, events.back(), ctx.clock()) + ".");
}

void answerChanges(AnswerContext& ctx) {
  const auto asked = ctx.question().thing.words.empty() ? std::optional(Things()) : ctx.resolveThing();
  if (!asked) {
    return;
  }
  const bool whether = ctx.question().any;
  if (whether && ctx.history() == nullptr) {
    ctx.answer.yes = false;
    return ctx.nothingFits("Not that I know: this home has no history.");
  }
  if (!hasHistory(ctx)) {
    return;
  }
  const ThingPhrase& phrase = ctx.question().thing;
  for (const PlacePhrase& place : phrase.places) {
    if (ctx.resolve(place.thing).things.empty()) {
      return ctx.nothingFits("I know of no " + place.thing.said + ".");
    }
  }
  const TimeSpan span = ctx.span().value_or(TimeSpan{ctx.clock().instantOf({ctx.clock().today(), 0}), ctx.clock().now_ns() + 1, false});
  EventTeller teller(ctx.index());
  std::vector<Event> events = ctx.history()->eventsBetween({span.from_ns, std::max(span.to_ns, span.from_ns + 1)});
  std::erase_if(events, [&](const Event& event) {
    return !(isChange(*ctx.history(), event) || isFirstMiss(*ctx.history(), event)) ||
           !isAskedFor(ctx, event, teller.thingOf(event.subject), *asked);
  });
  Things changed;
  std::vector<std::string> texts;
  for (const Event& event : events) {
    const Thing* thing = teller.thingOf(event.subject);
    if (thing != nullptr && std::find(changed.begin(), changed.end(), thing) == changed.end()) {
      changed.push_back(thing);
    }
  }
  ctx.take(changed);
  noteChanges(ctx, teller, events);
  const std::size_t first = ctx.answer.changes.size() > kMostTold ? ctx.answer.changes.size() - kMostTold : 0;
  for (std::size_t i = first; i < ctx.answer.changes.size(); ++i) {
    texts.push_back(ctx.answer.changes[i].text);
  }
  const std::string more = events.size() > texts.size() ? " Before that " + std::to_string(events.size() - texts.size()) + " more." : "";
  if (whether) {
    ctx.answer.yes = !texts.empty();
  }
  ctx.say(texts.empty() ? "nothing that I know of." : (whether ? "yes: " : "") + joined(texts, "; ") + "." + more);
}

void answerHistory(AnswerContext& ctx) {
  const auto things = ctx.resolveSome();
  if (!things || !hasHistory(ctx)) {
    return;
  }
  EventTeller teller(ctx.index());
  std::vector<Event> events = eventsOf(*ctx.history(), *things);
  eraseOutside(events, ctx.span());
  ctx.take(*things);
  noteChanges(ctx, teller, events);
  if (events.empty()) {
    return ctx.nothingFits("Nothing is recorded of the " + ctx.question().thing.said + ".");
  }
  std::vector<std::string> texts;
  std::string subject;
  if (events.size() == ctx.answer.changes.size() && events.front().before) {
    texts.push_back("at first " + teller.stateText(events.front().subject, *events.front().before));
  }
  for (const Change& change : ctx.answer.changes) {
    const bool same = change.event.subject == subject;
    texts.push_back(same ? eventText(teller, change.event, ctx.clock()) : change.text);
    subject = change.event.subject;
  }
  const std::string more = events.size() > texts.size() ? " Before that " + std::to_string(events.size() - texts.size()) + " more." : "";
  ctx.say(joined(texts, "; ") + "." + more);
}

}  // namespace oikos::semantic
