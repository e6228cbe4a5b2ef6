// SPDX-License-Identifier: Apache-2.0
#include "tools/track_answers.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/degrees.h"
#include "core/base/number_text.h"
#include "core/base/rfc3339.h"
#include "semantic/history/event_json.h"

namespace oikos::tools {

namespace {

using base::toFixedText;
using Json = nlohmann::ordered_json;
using registration::JointStatus;

bool turns(semantic::JointType type) {
  return type == semantic::JointType::kRevolute;
}

/// In the unit of files.
double written(double value, semantic::JointType type) {
  return turns(type) ? value / base::kRadPerDeg : value;
}

/// "70.2 deg", "25.1 cm".
std::string valueText(double value, semantic::JointType type) {
  return turns(type) ? toFixedText(value / base::kRadPerDeg, 1) + " deg" : toFixedText(100.0 * value, 1) + " cm";
}

double framesPerSecond(const tracking::RecordingStates& states) {
  const double elapsed_s = states.locating_s + states.reading_s;
  return elapsed_s > 0.0 ? states.frames / elapsed_s : 0.0;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

std::string stateText(const semantic::State& state) {
  if (const auto* const joint = std::get_if<semantic::JointValue>(&state)) {
    return valueText(joint->value, joint->type);
  }
  if (const auto* const knob = std::get_if<semantic::KnobSetting>(&state)) {
    return "'" + knob->state + "'";
  }
  if (const auto* const placement = std::get_if<semantic::Placement>(&state)) {
    return std::string(base::toString(placement->relation)) + " " + placement->parent;
  }
  const auto& pose = std::get<semantic::FurniturePose>(state).T_map_object;
  return "(" + toFixedText(pose.position_m.x(), 2) + ", " + toFixedText(pose.position_m.y(), 2) + ", " +
         toFixedText(pose.roll_pitch_yaw_rad.z() / base::kRadPerDeg, 1) + " deg)";
}

void printEvent(const tracking::StateEvent& event) {
  std::cout << "  " << padded(event.event.subject, 34) << padded(event.word, 7) << "  ";
  const auto* const joint = std::get_if<semantic::JointValue>(&*event.event.after);
  const semantic::JointType type = joint != nullptr ? joint->type : semantic::JointType::kPrismatic;
  if (event.event.kind == semantic::EventKind::kMissed) {
    std::cout << "not " << stateText(*event.event.after);
  } else {
    std::cout << stateText(*event.event.before) << " -> " << stateText(*event.event.after);
  }
  if (event.sigma > 0.0) {
    std::cout << " +- " << valueText(event.sigma, type);
  }
  std::cout << "  " << base::toRfc3339(event.event.time_ns) << ", frame " << *event.event.frame << ", sure to "
            << toFixedText(100.0 * event.event.confidence, 1) << " %\n";
}

/// Every joint in view, with its value at the recording's end.
void printReadings(const tracking::RecordingStates& states) {
  std::cout << "  joint                             status          value       sigma     stays images found\n";
  for (const tracking::PieceReading& piece : states.pieces) {
    for (const tracking::JointReading& joint : piece.joints) {
      if (joint.stays.empty()) {
        std::cout << "  " << padded(joint.id.value, 34) << "not in view\n";
        continue;
      }
      const tracking::JointStay& last = joint.stays.back();
      std::cout << "  " << padded(joint.id.value, 34) << padded(std::string(base::toString(last.span.status)), 16)
                << padded(valueText(last.span.value, joint.type), 12) << padded(valueText(std::sqrt(last.span.variance), joint.type), 10)
                << padded(std::to_string(joint.stays.size()), 6) << padded(std::to_string(last.images), 7) << last.found << '\n';
    }
  }
}

/// Every knob that was read, with its setting at the recording's end.
void printKnobs(const tracking::RecordingStates& states) {
  if (states.knobs.empty()) {
    return;
  }
  std::cout << "  knob                              setting     sure to     stays images read\n";
  for (const tracking::TrackedKnob& knob : states.knobs) {
    std::cout << "  " << padded(knob.id.value, 34);
    if (knob.stays.empty()) {
      std::cout << "cannot be read: " << knob.reason << '\n';
      continue;
    }
    const tracking::KnobStay& last = knob.stays.back();
    std::cout << padded("'" + knob.states[last.state] + "'", 12) << padded(toFixedText(100.0 * last.probability, 1) + " %", 12)
              << padded(std::to_string(knob.stays.size()), 6) << padded(std::to_string(last.images), 7) << last.found << '\n';
  }
}

std::string millimetres(double length_m) {
  return toFixedText(1000.0 * length_m, 0);
}

/// Handles that are elsewhere than home.xml has them.
void printHandles(const tracking::RecordingStates& states) {
  constexpr double kWorthTelling_m = 0.015;
  for (const tracking::PieceReading& piece : states.pieces) {
    for (const tracking::HandleReading& handle : piece.handles) {
      if (handle.found.seen > 1 && handle.off_m.norm() > kWorthTelling_m) {
        std::cout << "  handle " << handle.id << " is " << millimetres(handle.off_m.norm()) << " mm from where home.xml has it ("
                  << millimetres(handle.off_m.x()) << ", " << millimetres(handle.off_m.y()) << ", " << millimetres(handle.off_m.z())
                  << " in its own frame), in " << handle.found.seen << " of " << handle.found.images << " images\n";
      }
    }
  }
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

Json metres(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
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

void printChange(const tracking::ChangeBox& box) {
  const Eigen::Vector3d& center = box.change.center_map;
  const Eigen::Vector3d& size = box.change.size_m;
  std::cout << "  " << padded(std::string(base::toString(box.change.kind)), 5) << "at (" << toFixedText(center.x(), 2) << ", "
            << toFixedText(center.y(), 2) << ", " << toFixedText(center.z(), 2) << "), " << toFixedText(size.x(), 2) << " x "
            << toFixedText(size.y(), 2) << " x " << toFixedText(size.z(), 2) << " m" << (box.piece.empty() ? "" : ", of " + box.piece)
            << ", frame " << box.frame << ", sure to " << toFixedText(100.0 * box.change.confidence, 1) << " %\n";
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
    Json one = semantic::toJson(event.event);
    one["change"] = event.word;
    json["events"].push_back(std::move(one));
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

std::string eventText(const tracking::StateEvent& event) {
  if (event.event.kind == semantic::EventKind::kMissed) {
    return event.event.subject + " missed, not " + stateText(*event.event.after);
  }
  return event.event.subject + " " + event.word + " " + stateText(*event.event.before) + " -> " + stateText(*event.event.after);
}

void printText(const TrackedRecording& recording, const TrackTask& task) {
  const std::string folder = recording.folder.string();
  if (recording.status == TrackStatus::kKnown) {
    std::cout << folder << ": was tracked before, as '" << recording.name << "'\n";
    return;
  }
  const tracking::RecordingStates& states = recording.states;
  std::cout << folder << ": " << states.found << " of " << states.located << " frames found, " << states.registrations
            << " pictures of furniture read, in " << toFixedText(states.locating_s + states.reading_s, 1) << " s ("
            << toFixedText(framesPerSecond(states), 1) << " frames/s)\n";
  if (states.unreadable > 0) {
    std::cout << "  " << states.unreadable << " frames could not be read\n";
  }
  if (task.is_dry) {
    printReadings(states);
    printKnobs(states);
    printHandles(states);
  }
  std::cout << "  " << recording.events.size() << (recording.events.size() == 1 ? " event" : " events")
            << (task.is_dry ? " would be written\n" : "\n");
  for (const tracking::StateEvent& event : recording.events) {
    printEvent(event);
  }
  if (task.has_changes) {
    std::cout << "  " << recording.changes.size() << " changes against the map that nothing explains\n";
    std::for_each(recording.changes.begin(), recording.changes.end(), printChange);
  }
}

nlohmann::ordered_json toJson(const TrackOutcome& outcome, const TrackTask& task) {
  Json recordings = Json::array();
  for (const TrackedRecording& recording : outcome.recordings) {
    recordings.push_back(recordingJson(recording, task.has_changes));
  }
  return {
      {"dry_run", task.is_dry}, {"home_xml_is_written", !task.is_dry && outcome.checkpoint_problem.empty()}, {"recordings", recordings}};
}

}  // namespace oikos::tools
