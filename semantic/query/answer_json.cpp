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

Json poseJson(const Eigen::Isometry3d& T) {
  const Pose pose = Pose::fromIsometry(T);
  const Eigen::Vector3d& t = pose.position_m;
  const Eigen::Vector3d turned_deg = pose.roll_pitch_yaw_rad / kRadPerDeg;
  return {{"x_m", rounded(t.x())},
          {"y_m", rounded(t.y())},
          {"z_m", rounded(t.z())},
          {"roll_deg", rounded(turned_deg.x())},
          {"pitch_deg", rounded(turned_deg.y())},
          {"yaw_deg", rounded(turned_deg.z())}};
}

Json jointsJson(const std::vector<JointReading>& joints) {
  Json list = Json::array();
  for (const JointReading& joint : joints) {
    const bool turns = joint.type == JointType::kRevolute;
    list.push_back({{"id", joint.id}, {turns ? "value_deg" : "value_m", rounded(turns ? joint.value / kRadPerDeg : joint.value)}});
  }
  return list;
}

Json posesJson(const std::vector<Eigen::Isometry3d>& poses) {
  Json list = Json::array();
  for (const Eigen::Isometry3d& T : poses) {
    list.push_back(poseJson(T));
  }
  return list;
}

Json textOrNull(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json handlesJson(const std::vector<HandlePlace>& handles) {
  Json list = Json::array();
  for (const HandlePlace& handle : handles) {
    list.push_back({{"id", handle.id}, {"kind", base::toString(handle.kind)}, {"pose_map", poseJson(handle.T_map_handle)}});
  }
  return list;
}

Json usualPlacesJson(const std::vector<Placement>& places) {
  Json list = Json::array();
  for (const Placement& place : places) {
    list.push_back({{"parent", place.parent},
                    {"relation", base::toString(place.relation)},
                    {"pose_parent", poseJson(place.T_parent_object.toIsometry())}});
  }
  return list;
}

Json expectedJson(const std::vector<PlaceProbability>& places) {
  Json list = Json::array();
  for (const auto& [place, probability] : places) {
    list.push_back({{"parent", place.parent}, {"relation", base::toString(place.relation)}, {"probability", toThousandth(probability)}});
  }
  return list;
}

Json evidenceJson(const std::optional<Evidence>& evidence) {
  if (!evidence) {
    return {};
  }
  return {{"event", evidence->event},
          {"recording", textOrNull(evidence->recording)},
          {"frame", evidence->frame ? Json(*evidence->frame) : Json()},
          {"picture", textOrNull(evidence->picture)}};
}

Json thingJson(const FoundThing& found) {
  Json json{{"id", found.id}, {"name", found.name}, {"type", textOrNull(found.type)}, {"room", found.room}};
  json["parent"] = textOrNull(found.parent);
  json["relation"] = found.relation ? Json(base::toString(*found.relation)) : Json();
  json["pose_map"] = poseJson(found.T_map_thing);
  json["pose_parent"] = found.T_parent_thing ? poseJson(*found.T_parent_thing) : Json();
  json["parking_poses_map"] = posesJson(found.T_map_base);
  json["joints_to_move"] = jointsJson(found.joints_to_move);
  json["joints"] = jointsJson(found.joints);
  json["handles"] = handlesJson(found.handles);
  json["grasps_map"] = posesJson(found.T_map_grasp);
  json["usual_places"] = usualPlacesJson(found.usual_places);
  json["setting"] = textOrNull(found.setting);
  json["last_seen"] = found.last_seen_ns ? Json(base::toRfc3339(*found.last_seen_ns)) : Json();
  json["confidence"] = found.confidence ? Json(toThousandth(*found.confidence)) : Json();
  json["expected_at"] = expectedJson(found.expected_at);
  json["elsewhere"] = found.elsewhere ? Json(toThousandth(*found.elsewhere)) : Json();
  json["evidence"] = evidenceJson(found.evidence);
  return json;
}

Json stepJson(const PlanStep& step) {
  return {{"do", base::toString(step.kind)}, {"id", step.id}, {"poses_map", posesJson(step.T_map)}, {"text", step.text}};
}

}  // namespace

std::string toJson(const Answer& answer) {
  Json json{{"status", base::toString(answer.status)}, {"sentence", answer.sentence}};
  json["yes"] = answer.yes ? Json(*answer.yes) : Json();
  json["count"] = answer.count ? Json(*answer.count) : Json();
  json["at"] = answer.at_ns ? Json(base::toRfc3339(*answer.at_ns)) : Json();
  json["total"] = answer.total;
  json["found"] = Json::array();
  for (const FoundThing& found : answer.found) {
    json["found"].push_back(thingJson(found));
  }
  json["steps"] = Json::array();
  for (const PlanStep& step : answer.steps) {
    json["steps"].push_back(stepJson(step));
  }
  json["changes"] = Json::array();
  for (const Change& change : answer.changes) {
    json["changes"].push_back({{"thing", change.thing}, {"text", change.text}, {"event", toJson(change.event)}});
  }
  json["corrected"] = answer.corrected;
  json["not_understood"] = answer.not_understood;
  json["suggestions"] = answer.suggestions;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace oikos::semantic
