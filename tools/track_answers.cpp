// SPDX-License-Identifier: Apache-2.0
#include "tools/track_answers.h"

#include <cmath>
#include <iostream>
#include <string>

#include "core/base/degrees.h"
#include "core/base/number_text.h"
#include "core/base/rfc3339.h"

namespace oikos::tools {

namespace {

using base::toFixedText;

bool turns(semantic::JointType type) {
  return type == semantic::JointType::kRevolute;
}

/// "70.2 deg", "25.1 cm".
std::string valueText(double value, semantic::JointType type) {
  return turns(type) ? toFixedText(value / base::kRadPerDeg, 1) + " deg" : toFixedText(100.0 * value, 1) + " cm";
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
  std::cout << "  " << base::toRfc3339(event.event.time_ns) << ", frame " << *event.event.frame;
  if (event.last_before && *event.event.frame - event.last_before->frame > 1) {
    std::cout << ", as before up to frame " << event.last_before->frame;
  }
  std::cout << ", sure to " << toFixedText(100.0 * event.event.confidence, 1) << " %\n";
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

void printChange(const tracking::ChangeBox& box) {
  const Eigen::Vector3d& center = box.change.center_map;
  const Eigen::Vector3d& size = box.change.size_m;
  std::cout << "  " << padded(std::string(base::toString(box.change.kind)), 5) << "at (" << toFixedText(center.x(), 2) << ", "
            << toFixedText(center.y(), 2) << ", " << toFixedText(center.z(), 2) << "), " << toFixedText(size.x(), 2) << " x "
            << toFixedText(size.y(), 2) << " x " << toFixedText(size.z(), 2) << " m" << (box.piece.empty() ? "" : ", of " + box.piece)
            << ", frame " << box.frame << ", sure to " << toFixedText(100.0 * box.change.confidence, 1) << " %\n";
}

}  // namespace

double framesPerSecond(const tracking::RecordingStates& states) {
  const double elapsed_s = states.locating_s + states.reading_s;
  return elapsed_s > 0.0 ? states.frames / elapsed_s : 0.0;
}

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

}  // namespace oikos::tools
