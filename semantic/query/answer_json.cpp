// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "semantic/query/answer.h"

namespace oikos::semantic {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;

/// To the micrometre and the millionth of a degree; no -0.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

Json poseJson(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d& R = T.linear();
  const Eigen::Vector3d& t = T.translation();
  return {{"x_m", rounded(t.x())},
          {"y_m", rounded(t.y())},
          {"z_m", rounded(t.z())},
          {"roll_deg", rounded(std::atan2(R(2, 1), R(2, 2)) * kDegPerRad)},
          {"pitch_deg", rounded(std::asin(std::clamp(-R(2, 0), -1.0, 1.0)) * kDegPerRad)},
          {"yaw_deg", rounded(std::atan2(R(1, 0), R(0, 0)) * kDegPerRad)}};
}

Json jointsJson(const std::vector<JointReading>& joints) {
  Json list = Json::array();
  for (const JointReading& joint : joints) {
    const bool turns = joint.type == JointType::kRevolute;
    list.push_back({{"id", joint.id}, {turns ? "value_deg" : "value_m", rounded(turns ? joint.value * kDegPerRad : joint.value)}});
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
