// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/base/enum_table.h"
#include "semantic/model/home.h"
#include "semantic/model/pose.h"

namespace oikos::semantic {

/// What happened to an event's subject.
enum class EventKind {
  kSighted,    ///< a small object was seen; after: its placement
  kMissed,     ///< a small object was looked for in plain view and was not there; after: where it was looked for. Changes no state
  kMoved,      ///< a piece of furniture stands elsewhere; after: its pose
  kJoint,      ///< after: the joint's value
  kKnob,       ///< after: the knob's setting
  kCorrected,  ///< a person said so; holds until something newer is seen
  kEdited,     ///< home.xml was changed by hand; after: what stands there now, nothing where it is no state (a label, a model)
  kAdded,      ///< the subject is new in home.xml
  kRemoved,    ///< the subject is gone from home.xml
  kReverted,   ///< what a recording had said is taken back; after: the state from before it
  kForgotten,  ///< `evidence` was removed
};
constexpr auto enumTable(EventKind) {
  return std::to_array<base::EnumName<EventKind>>({{EventKind::kSighted, "sighted"},
                                                   {EventKind::kMissed, "missed"},
                                                   {EventKind::kMoved, "moved"},
                                                   {EventKind::kJoint, "joint"},
                                                   {EventKind::kKnob, "knob"},
                                                   {EventKind::kCorrected, "corrected"},
                                                   {EventKind::kEdited, "edited"},
                                                   {EventKind::kAdded, "added"},
                                                   {EventKind::kRemoved, "removed"},
                                                   {EventKind::kReverted, "reverted"},
                                                   {EventKind::kForgotten, "forgotten"}});
}

/// Where a piece of furniture stands.
struct FurniturePose {
  Pose T_map_object;
  bool operator==(const FurniturePose&) const = default;
};

struct JointValue {
  JointType type = JointType::kRevolute;
  double value = 0.0;  ///< rad or m
  bool operator==(const JointValue&) const = default;
};

struct KnobSetting {
  std::string state;  ///< a state's name
  bool operator==(const KnobSetting&) const = default;
};

using State = std::variant<Placement, FurniturePose, JointValue, KnobSetting>;

/// One line of a home's history: `(time, recording, subject, kind, before, after, confidence, evidence)`.
struct Event {
  std::int64_t number = 0;            ///< 1, 2, … in the order of commits; 0: not committed
  std::int64_t time_ns = 0;           ///< when it happened, since 1970, UTC
  std::string recording;              ///< its name; empty: of none
  std::optional<std::int64_t> frame;  ///< of the recording
  std::string subject;                ///< id of a small object, a piece of furniture, a joint or a knob
  EventKind kind = EventKind::kSighted;
  std::optional<State> before;  ///< as the history had it when the event came in
  std::optional<State> after;
  double confidence = 1.0;  ///< 0 to 1
  std::string evidence;     ///< picture crop, a path below the home; empty: none
  bool operator==(const Event&) const = default;
};

}  // namespace oikos::semantic
