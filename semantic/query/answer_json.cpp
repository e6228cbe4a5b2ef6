// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "semantic/query/answer.h"

namespace oikos::semantic {

namespace {

using Json = nlohmann::ordered_json;

/// To the micrometre and the millionth of a degree; no -0.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
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

Json thingJson(const FoundThing& found) {
  Json json{{"id", found.id}, {"name", found.name}, {"room", found.room}};
  json["parent"] = found.parent.empty() ? Json() : Json(found.parent);
  json["relation"] = found.relation ? Json(base::toString(*found.relation)) : Json();
  json["pose_map"] = poseJson(found.T_map_thing);
  json["pose_parent"] = found.T_parent_thing ? poseJson(*found.T_parent_thing) : Json();
  json["parking_poses_map"] = Json::array();
  for (const Eigen::Isometry3d& T_map_base : found.T_map_base) {
    json["parking_poses_map"].push_back(poseJson(T_map_base));
  }
  json["joints_to_move"] = jointsJson(found.joints_to_move);
  json["joints"] = jointsJson(found.joints);
  json["setting"] = found.setting.empty() ? Json() : Json(found.setting);
  json["last_seen_ns"] = found.last_seen_ns ? Json(*found.last_seen_ns) : Json();
  json["confidence"] = found.confidence ? Json(*found.confidence) : Json();
  return json;
}

}  // namespace

std::string toJson(const Answer& answer) {
  Json json{{"status", base::toString(answer.status)}, {"sentence", answer.sentence}, {"total", answer.total}, {"found", Json::array()}};
  for (const FoundThing& found : answer.found) {
    json["found"].push_back(thingJson(found));
  }
  json["corrected"] = answer.corrected;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace oikos::semantic
