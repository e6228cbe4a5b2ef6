// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/rfc3339.h"
#include "semantic/history/event_json.h"
#include "semantic/query/answer.h"

namespace oikos::semantic {

namespace {

using Json = nlohmann::ordered_json;

/// To the micrometre and the millionth of a degree; no -0.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

double toThousandth(double probability) {
  return std::round(probability * 1e3) / 1e3;
}

/// The members of an object in their order. Json's braced lists copy each member twice, which was two thirds of an answer's cost.
class Members {
 public:
  explicit Members(std::size_t count) { members_.reserve(count); }

  Members& add(const char* name, Json value) {
    members_.emplace_back(name, std::move(value));
    return *this;
  }

  [[nodiscard]] Json toJson() { return std::move(members_); }

 private:
  Json::object_t members_;
};

template <typename List, typename ToJson>
Json listJson(const List& list, const ToJson& to_json) {
  Json::array_t json;
  json.reserve(list.size());
  for (const auto& item : list) {
    json.push_back(to_json(item));
  }
  return json;
}

Json textOrNull(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json timeOrNull(std::optional<std::int64_t> time_ns) {
  return time_ns ? Json(base::toRfc3339(*time_ns)) : Json();
}

Json probabilityOrNull(std::optional<double> probability) {
  return probability ? Json(toThousandth(*probability)) : Json();
}

template <typename Value>
Json valueOrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json poseJson(const Eigen::Isometry3d& T) {
  const Pose pose = Pose::fromIsometry(T);
  const Eigen::Vector3d& t = pose.position_m;
  const Eigen::Vector3d turned_deg = pose.roll_pitch_yaw_rad / kRadPerDeg;
  return Members(6)
      .add("x_m", rounded(t.x()))
      .add("y_m", rounded(t.y()))
      .add("z_m", rounded(t.z()))
      .add("roll_deg", rounded(turned_deg.x()))
      .add("pitch_deg", rounded(turned_deg.y()))
      .add("yaw_deg", rounded(turned_deg.z()))
      .toJson();
}

Json jointJson(const JointReading& joint) {
  const bool turns = joint.type == JointType::kRevolute;
  return Members(2)
      .add("id", joint.id)
      .add(turns ? "value_deg" : "value_m", rounded(turns ? joint.value / kRadPerDeg : joint.value))
      .toJson();
}

Json handleJson(const HandlePlace& handle) {
  return Members(3).add("id", handle.id).add("kind", base::toString(handle.kind)).add("pose_map", poseJson(handle.T_map_handle)).toJson();
}

Json placementJson(const Placement& place) {
  return Members(3)
      .add("parent", place.parent)
      .add("relation", base::toString(place.relation))
      .add("pose_parent", poseJson(place.T_parent_object.toIsometry()))
      .toJson();
}

Json expectedJson(const PlaceProbability& expected) {
  return Members(3)
      .add("parent", expected.place.parent)
      .add("relation", base::toString(expected.place.relation))
      .add("probability", toThousandth(expected.probability))
      .toJson();
}

Json evidenceJson(const std::optional<Evidence>& evidence) {
  if (!evidence) {
    return {};
  }
  return Members(4)
      .add("event", evidence->event)
      .add("recording", textOrNull(evidence->recording))
      .add("frame", valueOrNull(evidence->frame))
      .add("picture", textOrNull(evidence->picture))
      .toJson();
}

Json thingJson(const FoundThing& found) {
  return Members(21)
      .add("id", found.id)
      .add("name", found.name)
      .add("type", textOrNull(found.type))
      .add("room", found.room)
      .add("parent", textOrNull(found.parent))
      .add("relation", found.relation ? Json(base::toString(*found.relation)) : Json())
      .add("pose_map", poseJson(found.T_map_thing))
      .add("pose_parent", found.T_parent_thing ? poseJson(*found.T_parent_thing) : Json())
      .add("parking_poses_map", listJson(found.T_map_base, poseJson))
      .add("joints_to_move", listJson(found.joints_to_move, jointJson))
      .add("joints", listJson(found.joints, jointJson))
      .add("handles", listJson(found.handles, handleJson))
      .add("grasps_map", listJson(found.T_map_grasp, poseJson))
      .add("usual_places", listJson(found.usual_places, placementJson))
      .add("setting", textOrNull(found.setting))
      .add("last_seen", timeOrNull(found.last_seen_ns))
      .add("missed", timeOrNull(found.missed_ns))
      .add("confidence", probabilityOrNull(found.confidence))
      .add("expected_at", listJson(found.expected_at, expectedJson))
      .add("elsewhere", probabilityOrNull(found.elsewhere))
      .add("evidence", evidenceJson(found.evidence))
      .toJson();
}

Json stepJson(const PlanStep& step) {
  return Members(4)
      .add("do", base::toString(step.kind))
      .add("id", step.id)
      .add("poses_map", listJson(step.T_map, poseJson))
      .add("text", step.text)
      .toJson();
}

Json changeJson(const Change& change) {
  return Members(3).add("thing", change.thing).add("text", change.text).add("event", toJson(change.event)).toJson();
}

}  // namespace

std::string toJson(const Answer& answer, int indent) {
  return Members(12)
      .add("status", base::toString(answer.status))
      .add("sentence", answer.sentence)
      .add("yes", valueOrNull(answer.yes))
      .add("count", valueOrNull(answer.count))
      .add("at", timeOrNull(answer.at_ns))
      .add("total", answer.total)
      .add("found", listJson(answer.found, thingJson))
      .add("steps", listJson(answer.steps, stepJson))
      .add("changes", listJson(answer.changes, changeJson))
      .add("corrected", answer.corrected)
      .add("not_understood", answer.not_understood)
      .add("suggestions", answer.suggestions)
      .toJson()
      .dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace oikos::semantic
