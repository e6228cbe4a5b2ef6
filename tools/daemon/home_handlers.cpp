// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/base/error.h"
#include "semantic/query/words.h"
#include "tools/daemon/handlers.h"
#include "tools/daemon/home_json.h"
#include "tools/daemon/json_response.h"
#include "tools/daemon/query_parameters.h"

namespace oikos::daemon {

namespace {

using semantic::Thing;
using semantic::ThingKind;

struct ObjectFilter {
  std::optional<std::string_view> type;
  std::optional<std::string_view> color;
  std::optional<std::string_view> room;
  std::optional<semantic::Relation> relation;
  std::optional<std::string_view> text;

  [[nodiscard]] bool takes(const Thing& thing) const;
};

bool hasColor(const semantic::SmallObject& small, std::string_view color) {
  return std::any_of(small.properties.begin(), small.properties.end(), [color](const semantic::Property& property) {
    return (property.name == "color" || property.name == "colour") && property.value == color;
  });
}

bool ObjectFilter::takes(const Thing& thing) const {
  if (thing.kind != ThingKind::kLargeObject && thing.kind != ThingKind::kSmallObject) {
    return false;
  }
  const semantic::SmallObject* const small = thing.kind == ThingKind::kSmallObject ? thing.small_object : nullptr;
  const std::string& its_type = small != nullptr ? small->type : thing.object->type;
  return (!type || *type == its_type) && (!room || *room == thing.room->id.value) &&
         (!color || (small != nullptr && hasColor(*small, *color))) && (!relation || (small != nullptr && small->relation == *relation));
}

ObjectFilter filterOf(const RequestTarget& target) {
  ObjectFilter filter{target.find("type"), target.find("color"), target.find("room"), std::nullopt, target.find("text")};
  filter.color = filter.color ? filter.color : target.find("colour");
  if (const std::optional<std::string_view> relation = target.find("relation")) {
    filter.relation = base::findEnum<semantic::Relation>(*relation);
    if (!filter.relation) {
      throw base::Error(base::ErrorCode::kInput, "'" + std::string(relation->substr(0, 64)) + "' is none of on, in, under", "relation");
    }
  }
  return filter;
}

/// Of the things that the text fits; of all if there is none.
std::vector<std::uint32_t> candidates(const semantic::HomeIndex& index, const ObjectFilter& filter) {
  std::vector<std::uint32_t> numbers;
  if (filter.text) {
    for (const semantic::Match& match : index.find(semantic::wordsOf(*filter.text)).matches) {
      numbers.push_back(match.thing);
    }
    return numbers;
  }
  numbers.resize(index.size());
  for (std::uint32_t number = 0; number < numbers.size(); ++number) {
    numbers[number] = number;
  }
  return numbers;
}

}  // namespace

Response answerHome(const Call& call) {
  const std::shared_ptr<const HomeView> view = call.service.view();
  const semantic::Home& home = view->snapshot->home;
  return jsonResponse({{"id", home.id},
                       {"name", home.name},
                       {"version", home.version},
                       {"time_zone", home.time_zone},
                       {"as_of", home.as_of},
                       {"dock_map", poseJson(home.T_map_dock.toIsometry())},
                       {"rooms", home.rooms.size()},
                       {"things", view->index.size()}});
}

Response answerRooms(const Call& call) {
  const Page page = pageOf(call.target);
  const std::shared_ptr<const HomeView> view = call.service.view();
  const std::vector<semantic::Room>& rooms = view->snapshot->home.rooms;
  Json json{{"rooms", Json::array()}};
  for (std::size_t i = page.offset; i < rooms.size() && page.holds(i); ++i) {
    json["rooms"].push_back(roomJson(rooms[i]));
  }
  page.describe(json, rooms.size());
  return jsonResponse(json);
}

Response answerObjects(const Call& call) {
  const Page page = pageOf(call.target);
  const ObjectFilter filter = filterOf(call.target);
  const std::shared_ptr<const HomeView> view = call.service.view();
  Json json{{"objects", Json::array()}};
  std::size_t total = 0;
  for (const std::uint32_t number : candidates(view->index, filter)) {
    const Thing& thing = view->index.thing(number);
    if (filter.takes(thing) && page.holds(total++)) {
      json["objects"].push_back(summaryJson(thing));
    }
  }
  page.describe(json, total);
  return jsonResponse(json);
}

Response answerObject(const Call& call) {
  const std::shared_ptr<const HomeView> view = call.service.view();
  const Thing* const thing = view->index.findById(call.id);
  if (thing == nullptr) {
    return failure(404, "not_found", "the home has nothing with the id '" + call.id.substr(0, 64) + "'");
  }
  return jsonResponse(thingJson(*thing));
}

}  // namespace oikos::daemon
