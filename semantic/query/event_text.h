// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "semantic/history/event.h"
#include "semantic/query/home_index.h"

namespace oikos::semantic {

/// Events as a person would tell them, of one home. The index must outlive it. Not thread-safe.
class EventTeller {
 public:
  explicit EventTeller(const HomeIndex& index) : index_(index) {}

  /// What has changed: of a joint the part that it moves, or the whole door; null: it is no longer in the home.
  [[nodiscard]] const Thing* thingOf(const std::string& subject);
  /// The subjects of events that change the thing: itself, its joints and knobs.
  [[nodiscard]] static std::vector<std::string> subjectsOf(const Thing& thing);
  /// Whether state `after` differs from `before` by more than a reading may be off.
  [[nodiscard]] static bool isChange(const State& before, const State& after);
  /// Of a joint: whether that is open; nothing: it is no joint of the home, or no state of one.
  [[nodiscard]] std::optional<bool> isOpenIn(const std::string& subject, const State& state);
  /// "on the desk", "open by 90 degrees", "set to off", "stands at (1.80, -0.25)".
  [[nodiscard]] std::string stateText(const std::string& subject, const State& state);

 private:
  struct JointPlace {
    const Thing* thing = nullptr;
    const Joint* joint = nullptr;
  };
  [[nodiscard]] const JointPlace* findJoint(const std::string& subject);

  const HomeIndex& index_;
  std::unordered_map<std::string_view, JointPlace> joints_;  // of every one; filled when one is asked for
};

}  // namespace oikos::semantic
