// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/base/rfc3339.h"
#include "semantic/history/event_json.h"
#include "tools/daemon/handlers.h"
#include "tools/daemon/json_response.h"
#include "tools/daemon/observed_places.h"

namespace oikos::daemon {

namespace {

using semantic::Event;
using semantic::EventKind;

constexpr std::size_t kMostEvents = 10'000;
constexpr std::array kObservable{EventKind::kSighted, EventKind::kMissed, EventKind::kMoved,
                                 EventKind::kJoint,   EventKind::kKnob,   EventKind::kCorrected};

/// An event is four levels deep, in a list. What is deeper would be refused later, by functions that go down with it.
nlohmann::json parseBody(const std::string& body) {
  constexpr int kDeepest = 8;
  const auto refuse_depth = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kDeepest) {
      throw base::Error(base::ErrorCode::kInput, "brackets are nested more than 8 deep", "body");
    }
    return true;
  };
  try {
    return nlohmann::json::parse(body, refuse_depth);
  } catch (const nlohmann::json::parse_error& error) {
    throw base::Error(base::ErrorCode::kInput,
                      "no JSON at byte " + std::to_string(error.byte) + ": an event or a list of events is expected", "body");
  } catch (const nlohmann::json::out_of_range&) {
    throw base::Error(base::ErrorCode::kInput, "a number is too great for a double", "body");
  }
}

/// Of a small object that was observed in `map` the placement, in place of that pose.
void placeByMap(nlohmann::json& json, const std::string& where, const ObservedPlaces& places) {
  const bool in_map = json.is_object() && json.contains("after") && json["after"].is_object() && json["after"].contains("pose_map");
  if (!in_map || !json.contains("subject") || !json["subject"].is_string()) {
    return;
  }
  const semantic::Pose T_map_object = semantic::mapPoseFromJson(json["after"], where + ": after");
  json["after"] = semantic::toJson(semantic::State(places.get(json["subject"], T_map_object, where + ": after: pose_map")));
}

Event readEvent(nlohmann::json json, const std::string& where, std::int64_t now_ns, const ObservedPlaces& places) {
  if (json.is_object() && !json.contains("time")) {
    json["time"] = base::toRfc3339(now_ns);
  }
  placeByMap(json, where, places);
  Event event = semantic::eventFromJson(json, where);
  if (std::find(kObservable.begin(), kObservable.end(), event.kind) == kObservable.end()) {
    throw base::Error(base::ErrorCode::kInput,
                      "'" + std::string(base::toString(event.kind)) +
                          "' is written by Oikos itself; sighted, missed, moved, joint, knob and corrected can be observed",
                      where + ".kind");
  }
  return event;
}

std::vector<Event> readEvents(const nlohmann::json& json, std::int64_t now_ns, ObservedPlaces places) {
  std::vector<Event> events;
  if (!json.is_array()) {
    events.push_back(readEvent(json, "event", now_ns, places));
    return events;
  }
  if (json.empty() || json.size() > kMostEvents) {
    throw base::Error(base::ErrorCode::kInput,
                      "a list of " + std::to_string(json.size()) + " events: 1 to " + std::to_string(kMostEvents) + " are taken at a time",
                      "body");
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    events.push_back(readEvent(json[i], "events[" + std::to_string(i) + "]", now_ns, places));
    places.take(events.back());
  }
  return events;
}

}  // namespace

Response takeObservations(const Call& call) {
  const std::shared_ptr<const HomeView> view = call.service.view();
  std::vector<Event> events =
      readEvents(parseBody(call.request.body), call.service.now_ns(), ObservedPlaces(call.service.snapshot(), view->index));
  const auto count = static_cast<std::int64_t>(events.size());
  std::int64_t last = 0;
  try {
    last = call.service.append(std::move(events));
  } catch (const base::Error& error) {
    if (error.code() == base::ErrorCode::kIo) {
      return failure(507, "not_stored", std::string("nothing was stored: ") + error.what());
    }
    throw;
  }
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (std::int64_t number = last - count + 1; number <= last; ++number) {
    numbers.push_back(number);
  }
  return jsonResponse({{"numbers", std::move(numbers)}});
}

}  // namespace oikos::daemon
