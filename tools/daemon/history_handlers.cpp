// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <limits>

#include "core/base/error.h"
#include "core/base/rfc3339.h"
#include "semantic/history/event_json.h"
#include "semantic/history/home_state.h"
#include "tools/daemon/handlers.h"
#include "tools/daemon/home_json.h"
#include "tools/daemon/json_response.h"
#include "tools/daemon/query_parameters.h"

namespace oikos::daemon {

namespace {

using semantic::Event;
using semantic::Home;

Response eventsResponse(const std::vector<Event>& events, const Page& page) {
  Json json{{"events", Json::array()}};
  for (std::size_t i = page.offset; i < events.size() && page.holds(i); ++i) {
    json["events"].push_back(semantic::toJson(events[i]));
  }
  page.describe(json, events.size());
  return jsonResponse(json);
}

/// Whose events tell of a thing: its own, and those of all that moves on it.
std::vector<std::string> subjectsOf(const semantic::Thing& thing) {
  std::vector<std::string> subjects{thing.id()};
  const bool has_parts = thing.kind == semantic::ThingKind::kLargeObject || thing.kind == semantic::ThingKind::kPart;
  if (!has_parts || !thing.object->articulation) {
    return subjects;
  }
  for (const semantic::Joint& joint : thing.object->articulation->joints) {
    if (thing.part == nullptr || joint.child == thing.part->id) {
      subjects.push_back(joint.id.value);
    }
  }
  for (const semantic::Knob& knob : thing.object->articulation->knobs) {
    if (thing.part == nullptr || knob.part == thing.part->id) {
      subjects.push_back(knob.id.value);
    }
  }
  return subjects;
}

std::vector<Event> eventsOf(const semantic::History& history, const std::vector<std::string>& subjects) {
  std::vector<Event> events;
  for (const std::string& subject : subjects) {
    std::vector<Event> its = history.eventsOf(subject);
    std::move(its.begin(), its.end(), std::back_inserter(events));
  }
  std::sort(events.begin(), events.end(),
            [](const Event& a, const Event& b) { return std::pair(a.time_ns, a.number) < std::pair(b.time_ns, b.number); });
  return events;
}

/// Lists one piece of all states, in the order of the file.
class StateList {
 public:
  explicit StateList(const Page& page) : page_(page) {}

  void add(const std::string& subject, const semantic::State& state) {
    if (page_.holds(total_++)) {
      states_.push_back({{"subject", subject}, {"state", semantic::toJson(state)}});
    }
  }
  void add(const semantic::SmallObject& small) {
    add(small.id.value, semantic::Placement{small.parent, small.relation, small.T_parent_object});
  }
  void add(const semantic::LargeObject& object);
  void add(const Home& home);

  void describe(Json& json) {
    json["states"] = std::move(states_);
    page_.describe(json, total_);
  }

 private:
  const Page page_;
  std::size_t total_ = 0;
  Json states_ = Json::array();
};

void StateList::add(const semantic::LargeObject& object) {
  add(object.id.value, semantic::FurniturePose{object.T_map_object});
  if (object.articulation) {
    for (const semantic::Joint& joint : object.articulation->joints) {
      add(joint.id.value, semantic::JointValue{joint.type, joint.value});
    }
    for (const semantic::Knob& knob : object.articulation->knobs) {
      add(knob.id.value, semantic::KnobSetting{knob.current});
    }
  }
  for (const semantic::SmallObject& small : object.small_objects) {
    add(small);
  }
}

void StateList::add(const Home& home) {
  for (const semantic::Room& room : home.rooms) {
    for (const auto& object : room.objects) {
      add(*object);
    }
    for (const semantic::SmallObject& small : room.small_objects) {
      add(small);
    }
  }
}

}  // namespace

Response answerObjectHistory(const Call& call) {
  const Page page = pageOf(call.target);
  const std::shared_ptr<const HomeView> view = call.service.view();
  const semantic::Thing* const thing = view->index.findById(call.id);
  const std::vector<Event> events =
      eventsOf(call.service.history(), thing == nullptr ? std::vector<std::string>{call.id} : subjectsOf(*thing));
  if (thing == nullptr && events.empty()) {
    return failure(404, "not_found", "neither the home nor its history has anything with the id '" + call.id.substr(0, 64) + "'");
  }
  return eventsResponse(events, page);
}

Response answerChanges(const Call& call) {
  const Page page = pageOf(call.target);
  const std::optional<std::int64_t> since_ns = findTime_ns(call.target, "since");
  if (!since_ns) {
    return failure(400, "bad_request", "since: the time is missing, such as 2024-05-17T09:30:00Z");
  }
  constexpr std::int64_t kEver_ns = std::numeric_limits<std::int64_t>::max();
  const semantic::History& history = call.service.history();
  Json json{{"events", Json::array()}};
  for (const Event& event : history.eventsBetween({*since_ns, kEver_ns, page.offset, page.limit})) {
    json["events"].push_back(semantic::toJson(event));
  }
  page.describe(json, history.countBetween(*since_ns, kEver_ns));
  return jsonResponse(json);
}

Response answerState(const Call& call) {
  const Page page = pageOf(call.target);
  const std::optional<std::int64_t> at_ns = findTime_ns(call.target, "at");
  const std::shared_ptr<const HomeView> view = call.service.view();
  const Home& home = view->snapshot->home;
  Json json{{"at", base::toRfc3339(at_ns.value_or(call.service.now_ns()))}};
  StateList states(page);
  if (at_ns) {
    states.add(semantic::homeAt(home, call.service.history(), *at_ns));
  } else {
    states.add(home);
  }
  states.describe(json);
  return jsonResponse(json);
}

Response answerEvents(const Call& call) {
  const std::int64_t last = call.service.history().lastNumber();
  std::int64_t after = last;
  if (const std::string& id = call.request.last_event_id; !id.empty()) {
    const auto [end, failed] = std::from_chars(id.data(), id.data() + id.size(), after);
    if (failed != std::errc() || end != id.data() + id.size() || after < 0) {
      throw base::Error(base::ErrorCode::kInput, "'" + id.substr(0, 64) + "' is no event's number", "Last-Event-ID");
    }
  }
  Response response;
  response.status = 200;
  response.content_type = "text/event-stream";
  response.events_after = std::min(after, last);
  return response;
}

}  // namespace oikos::daemon
