// SPDX-License-Identifier: Apache-2.0
// The answers of `oikos track` for programs.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/degrees.h"
#include "core/base/rfc3339.h"
#include "semantic/history/event_json.h"
#include "tools/track_answers.h"

namespace oikos::tools {

namespace {

using Json = nlohmann::ordered_json;

bool turns(semantic::JointType type) {
  return type == semantic::JointType::kRevolute;
}

/// In the unit of files.
double written(double value, semantic::JointType type) {
  return turns(type) ? value / base::kRadPerDeg : value;
}

Json metres(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json handleJson(const tracking::HandleReading& handle) {
  const registration::FusedHandle& found = handle.found;
  const semantic::Pose pose = semantic::Pose::fromIsometry(found.T_part_handle);
  Json json = {{"id", handle.id}, {"status", base::toString(found.status)}, {"images", found.images}, {"seen", found.seen}};
  if (found.seen > 0 || found.is_summed) {
    json["pose_part"] = {{"x_m", pose.position_m.x()},
                         {"y_m", pose.position_m.y()},
                         {"z_m", pose.position_m.z()},
                         {"roll_deg", pose.roll_pitch_yaw_rad.x() / base::kRadPerDeg},
                         {"pitch_deg", pose.roll_pitch_yaw_rad.y() / base::kRadPerDeg},
                         {"yaw_deg", pose.roll_pitch_yaw_rad.z() / base::kRadPerDeg}};
    json["sigma_m"] = std::sqrt(found.covariance.topLeftCorner<3, 3>().trace() / 3.0);
    json["length_m"] = found.length_m;
    json["off_m"] = {handle.off_m.x(), handle.off_m.y(), handle.off_m.z()};
    json["off_deg"] = handle.off_rad / base::kRadPerDeg;
    json["spread_m"] = found.spread_m;
  }
  return json;
}

Json knobsJson(const tracking::RecordingStates& states) {
  Json knobs = Json::array();
  for (const tracking::TrackedKnob& knob : states.knobs) {
    Json stays = Json::array();
    for (const tracking::KnobStay& stay : knob.stays) {
      stays.push_back({{"state", knob.states[stay.state]},
                       {"probability", stay.probability},
                       {"frame", stay.first_frame},
                       {"images", stay.images},
                       {"found", stay.found}});
    }
    Json one = {{"id", knob.id.value}, {"images", knob.images}, {"stays", std::move(stays)}};
    if (!knob.reason.empty()) {
      one["reason"] = knob.reason;
    }
    knobs.push_back(std::move(one));
  }
  return knobs;
}

Json stayJson(const tracking::JointStay& stay, const tracking::JointReading& joint, std::int64_t start_ns) {
  const std::string unit = turns(joint.type) ? "deg" : "m";
  return {{"status", base::toString(stay.span.status)},
          {"value_" + unit, written(stay.span.value, joint.type)},
          {"sigma_" + unit, written(std::sqrt(stay.span.variance), joint.type)},
          {"confidence", stay.span.confidence},
          {"from", base::toRfc3339(start_ns + stay.span.first_ns)},
          {"to", base::toRfc3339(start_ns + stay.span.last_ns)},
          {"frame", stay.first_frame},
          {"images", stay.images},
          {"found", stay.found}};
}

Json piecesJson(const TrackedRecording& recording) {
  Json pieces = Json::array();
  for (const tracking::PieceReading& piece : recording.states.pieces) {
    Json joints = Json::array();
    for (const tracking::JointReading& joint : piece.joints) {
      Json stays = Json::array();
      for (const tracking::JointStay& stay : joint.stays) {
        stays.push_back(stayJson(stay, joint, recording.start_ns));
      }
      joints.push_back({{"id", joint.id.value}, {"stays", std::move(stays)}});
    }
    Json handles = Json::array();
    for (const tracking::HandleReading& handle : piece.handles) {
      handles.push_back(handleJson(handle));
    }
    pieces.push_back({{"id", piece.id.value},
                      {"frames_in_view", piece.frames_in_view},
                      {"images", piece.images},
                      {"not_there", piece.not_there},
                      {"joints", std::move(joints)},
                      {"handles", std::move(handles)}});
  }
  return pieces;
}

Json furnitureJson(const tracking::FurniturePlace& place) {
  const semantic::Pose pose = semantic::Pose::fromIsometry(place.T_map_object);
  return {{"id", place.id.value},
          {"x_m", pose.position_m.x()},
          {"y_m", pose.position_m.y()},
          {"yaw_deg", pose.roll_pitch_yaw_rad.z() / base::kRadPerDeg},
          {"views", place.views},
          {"spread_m", place.spread_m},
          {"fit", place.fit}};
}

Json changesJson(const TrackedRecording& recording) {
  Json changes = Json::array();
  for (std::size_t i = 0; i < recording.changes.size(); ++i) {
    const auto& [change, piece, frame, crop] = recording.changes[i];
    Json one = {{"kind", base::toString(change.kind)}, {"center_map_m", metres(change.center_map)}, {"size_m", metres(change.size_m)}};
    one["support_height_m"] = change.support_height_m ? Json(*change.support_height_m) : Json(nullptr);
    one["confidence"] = change.confidence;
    one["piece"] = piece.empty() ? Json(nullptr) : Json(piece);
    one["frame"] = frame;
    if (i < recording.pictures.size()) {
      one["picture"] = recording.pictures[i];
    }
    changes.push_back(std::move(one));
  }
  return changes;
}

Json objectJson(const tracking::ObjectReading& object, std::int64_t start_ns) {
  Json json = {{"id", object.id.value},
               {"status", base::toString(object.status)},
               {"parent", object.placement.parent},
               {"images", object.views},
               {"there", object.there},
               {"not_there", object.not_there},
               {"hidden", object.hidden}};
  if (object.status == tracking::WatchStatus::kMissed) {
    json["confidence"] = object.confidence;
    json["from"] = base::toRfc3339(start_ns + object.stamp_ns);
    json["frame"] = object.frame;
  }
  return json;
}

Json eventJson(const tracking::StateEvent& event, std::int64_t start_ns) {
  Json json = semantic::toJson(event.event);
  json["change"] = event.word;
  if (event.event.kind == semantic::EventKind::kJoint) {
    json["last_before"] = event.last_before
                              ? Json{{"time", base::toRfc3339(start_ns + event.last_before->stamp_ns)}, {"frame", event.last_before->frame}}
                              : Json(nullptr);
  }
  return json;
}

Json recordingJson(const TrackedRecording& recording, bool has_changes) {
  Json json = {{"recording", recording.folder.string()}, {"status", base::toString(recording.status)}};
  if (!recording.name.empty()) {
    json["name"] = recording.name;
  }
  if (recording.status == TrackStatus::kFailed) {
    json["code"] = static_cast<int>(recording.code);
    json["problem"] = recording.problem;
    return json;
  }
  if (recording.status == TrackStatus::kKnown) {
    return json;
  }
  const tracking::RecordingStates& states = recording.states;
  json["frames"] = states.frames;
  json["skipped_frames"] = states.unreadable;
  json["looked_for"] = states.located;
  json["found"] = states.found;
  json["registrations"] = states.registrations;
  json["opening_s"] = recording.opening_s;
  json["locating_s"] = states.locating_s;
  json["reading_s"] = states.reading_s;
  json["frames_per_s"] = framesPerSecond(states);
  json["events"] = Json::array();
  for (const tracking::StateEvent& event : recording.events) {
    json["events"].push_back(eventJson(event, recording.start_ns));
  }
  json["pieces"] = piecesJson(recording);
  json["knobs"] = knobsJson(states);
  json["furniture"] = Json::array();
  for (const tracking::FurniturePlace& place : states.furniture) {
    json["furniture"].push_back(furnitureJson(place));
  }
  if (has_changes) {
    json["comparing_s"] = recording.comparing_s;
    json["changes"] = changesJson(recording);
  }
  json["objects"] = Json::array();
  for (const tracking::ObjectReading& object : states.objects) {
    json["objects"].push_back(objectJson(object, recording.start_ns));
  }
  return json;
}

}  // namespace

nlohmann::ordered_json toJson(const TrackOutcome& outcome, const TrackTask& task) {
  Json recordings = Json::array();
  for (const TrackedRecording& recording : outcome.recordings) {
    recordings.push_back(recordingJson(recording, task.has_changes));
  }
  return {
      {"dry_run", task.is_dry}, {"home_xml_is_written", !task.is_dry && outcome.checkpoint_problem.empty()}, {"recordings", recordings}};
}

}  // namespace oikos::tools
