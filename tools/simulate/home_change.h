// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "semantic/model/home.h"

namespace oikos::simulate {

/// A joint's new value, in the unit that it was written in.
struct JointChange {
  double value = 0.0;  ///< rad or m
  semantic::JointType type = semantic::JointType::kRevolute;
};
struct KnobChange {
  std::string state;
};
struct Gone {};
/// A small object's new place, or, with no parent, where a piece of furniture stands in `map`.
struct Moved {
  std::string parent;
  semantic::Relation relation = semantic::Relation::kOn;
  semantic::Pose pose;
};

/// What a scene changes of a home: `[@SECONDS] ID VALUE deg|m`, `ID STATE`, `ID gone`, `ID at X Y Z ROLL PITCH YAW` or
/// `ID on|in|under PARENT at X Y Z ROLL PITCH YAW`. Without a time: before the start.
struct HomeChange {
  double at_s = -1.0;
  std::string id;
  std::variant<JointChange, KnobChange, Gone, Moved> what;
};

/// Nothing: the text is none.
[[nodiscard]] std::optional<HomeChange> parseHomeChange(const std::string& text);

enum class BeyondLimits { kRefuse, kStop };

/// Throws Error{kInput} with `where` if the home has no such id, or nothing of the kind that can change in this way; a joint stays within
/// its limits. The home is then as it was. A joint whose new value is beyond its limits is
/// refused, or stops there: those of the true home are not quite those that a scene's author can know.
void apply(const HomeChange& change, semantic::Home& home, const std::string& where, BeyondLimits beyond = BeyondLimits::kRefuse);

}  // namespace oikos::simulate
