// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/event_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/rfc3339.h"

namespace oikos::semantic {

namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

OrderedJson poseJson(const Pose& pose) {
  const Eigen::Vector3d& p = pose.position_m;
  const Eigen::Vector3d& a = pose.roll_pitch_yaw_rad;
  return OrderedJson::array({p.x(), p.y(), p.z(), base::toDegrees(a.x()), base::toDegrees(a.y()), base::toDegrees(a.z())});
}

struct StateToJson {
  OrderedJson operator()(const Placement& p) const {
    return {{"parent", p.parent}, {"relation", base::toString(p.relation)}, {"pose", poseJson(p.T_parent_object)}};
  }
  OrderedJson operator()(const FurniturePose& p) const { return {{"pose", poseJson(p.T_map_object)}}; }
  OrderedJson operator()(const JointValue& j) const {
    return j.type == JointType::kRevolute ? OrderedJson{{"value_deg", base::toDegrees(j.value)}} : OrderedJson{{"value_m", j.value}};
  }
  OrderedJson operator()(const KnobSetting& k) const { return {{"setting", k.state}}; }
};

/// The keys of one object, each to be asked for once.
class Reader {
 public:
  Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) {
      fail("found " + shown(json) + "; expected an object");
    }
  }

  [[noreturn]] void fail(const std::string& what) const { throw base::Error(base::ErrorCode::kInput, what, where_); }

  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }

  const Json* find(const char* key) {
    asked_.emplace_back(key);
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }

  const Json& get(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr) {
      fail(std::string("no '") + key + "'");
    }
    return *value;
  }

  std::string text(const char* key) {
    const Json& value = get(key);
    if (!value.is_string() || value.get_ref<const std::string&>().find('\0') != std::string::npos) {
      fail(wrong(key, value, "a text"));
    }
    return value.get<std::string>();
  }

  std::string textOr(const char* key, const std::string& otherwise) { return has(key) ? text(key) : otherwise; }

  double number(const char* key) {
    const Json& value = get(key);
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      fail(wrong(key, value, "a finite number"));
    }
    return value.get<double>();
  }

  template <base::NamedEnum Enum>
  Enum choice(const char* key) {
    const std::string name = text(key);
    const auto found = base::findEnum<Enum>(name);
    if (!found) {
      std::string names;
      for (const std::string& known : base::enumNames<Enum>()) {
        names += (names.empty() ? "" : ", ") + known;
      }
      fail(wrong(key, name, "one of " + names));
    }
    return *found;
  }

  Pose pose(const char* key) {
    const Json& value = get(key);
    const auto isFinite = [](const Json& n) { return n.is_number() && std::isfinite(n.get<double>()); };
    if (!value.is_array() || value.size() != 6 || !std::all_of(value.begin(), value.end(), isFinite)) {
      fail(wrong(key, value, "six finite numbers: x y z in m, roll pitch yaw in degrees"));
    }
    std::array<double, 6> n{};
    std::transform(value.begin(), value.end(), n.begin(), [](const Json& number) { return number.get<double>(); });
    return {{n[0], n[1], n[2]}, Eigen::Vector3d(n[3], n[4], n[5]) * kRadPerDeg};
  }

  std::int64_t time(const char* key) {
    const std::string value = text(key);
    const auto time_ns = base::parseRfc3339Ns(value);
    if (!time_ns) {
      fail(wrong(key, value, "a time with its offset, for instance 2026-03-02T08:00:00Z"));
    }
    return *time_ns;
  }

  void refuseOthers() const {
    for (const auto& [key, value] : json_.items()) {
      if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) {
        fail("unknown key '" + key + "'");
      }
    }
  }

 private:
  static std::string shown(const Json& value) {
    constexpr std::size_t kMost = 60;
    std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() > kMost ? text.substr(0, kMost) + "…" : text;
  }
  static std::string wrong(const char* key, const Json& value, const std::string& expected) {
    return std::string(key) + " = " + shown(value) + ": expected " + expected;
  }

  const Json& json_;
  std::string where_;
  std::vector<std::string> asked_;
};

State readState(Reader& reader) {
  if (reader.has("parent")) {
    Placement placement{reader.text("parent"), reader.choice<Relation>("relation"), reader.pose("pose")};
    return placement;
  }
  if (reader.has("pose")) {
    return FurniturePose{reader.pose("pose")};
  }
  if (reader.has("value_deg")) {
    return JointValue{JointType::kRevolute, reader.number("value_deg") * kRadPerDeg};
  }
  if (reader.has("value_m")) {
    return JointValue{JointType::kPrismatic, reader.number("value_m")};
  }
  if (reader.has("setting")) {
    return KnobSetting{reader.text("setting")};
  }
  reader.fail("expected a placement (parent, relation, pose), a pose, a value_deg, a value_m or a setting");
}

std::optional<State> findState(Reader& reader, const char* key) {
  const Json* const json = reader.find(key);
  return json == nullptr ? std::nullopt : std::optional(stateFromJson(*json, reader.where() + ": " + key));
}

std::optional<std::int64_t> findFrame(Reader& reader) {
  const Json* const json = reader.find("frame");
  if (json == nullptr) {
    return std::nullopt;
  }
  if (!json->is_number_integer() || json->get<std::int64_t>() < 0) {
    reader.fail("frame = " + json->dump() + ": expected a number from 0 on");
  }
  return json->get<std::int64_t>();
}

}  // namespace

OrderedJson toJson(const State& state) {
  return std::visit(StateToJson{}, state);
}

OrderedJson toJson(const Event& event) {
  OrderedJson json{{"number", event.number}, {"time", base::toRfc3339(event.time_ns)}};
  if (!event.recording.empty()) {
    json["recording"] = event.recording;
  }
  if (event.frame) {
    json["frame"] = *event.frame;
  }
  json["subject"] = event.subject;
  json["kind"] = base::toString(event.kind);
  if (event.before) {
    json["before"] = toJson(*event.before);
  }
  if (event.after) {
    json["after"] = toJson(*event.after);
  }
  json["confidence"] = event.confidence;
  if (!event.evidence.empty()) {
    json["evidence"] = event.evidence;
  }
  return json;
}

State asStored(const State& state) {
  const auto angle = [](double rad) { return base::toDegrees(rad) * kRadPerDeg; };
  State stored = state;
  if (auto* const placement = std::get_if<Placement>(&stored)) {
    placement->T_parent_object.roll_pitch_yaw_rad = placement->T_parent_object.roll_pitch_yaw_rad.unaryExpr(angle);
  } else if (auto* const pose = std::get_if<FurniturePose>(&stored)) {
    pose->T_map_object.roll_pitch_yaw_rad = pose->T_map_object.roll_pitch_yaw_rad.unaryExpr(angle);
  } else if (auto* const joint = std::get_if<JointValue>(&stored); joint != nullptr && joint->type == JointType::kRevolute) {
    joint->value = angle(joint->value);
  }
  return stored;
}

State stateFromJson(const Json& json, const std::string& where) {
  Reader reader(json, where);
  State state = readState(reader);
  reader.refuseOthers();
  return state;
}

Pose mapPoseFromJson(const Json& json, const std::string& where) {
  Reader reader(json, where);
  const Pose pose = reader.pose("pose_map");
  reader.refuseOthers();
  return pose;
}

Event eventFromJson(const Json& json, const std::string& where) {
  Reader reader(json, where);
  Event event;
  (void)reader.find("number");  // the history gives them
  event.time_ns = reader.time("time");
  event.recording = reader.textOr("recording", "");
  event.frame = findFrame(reader);
  event.subject = reader.text("subject");
  event.kind = reader.choice<EventKind>("kind");
  event.before = findState(reader, "before");
  event.after = findState(reader, "after");
  event.confidence = reader.has("confidence") ? reader.number("confidence") : 1.0;
  if (event.confidence < 0.0 || event.confidence > 1.0) {
    reader.fail("confidence: expected from 0 to 1");
  }
  event.evidence = reader.textOr("evidence", "");
  // asked for whether there or not, so that they are known
  for (const char* key : {"recording", "confidence", "evidence"}) {
    (void)reader.find(key);
  }
  reader.refuseOthers();
  return event;
}

}  // namespace oikos::semantic
