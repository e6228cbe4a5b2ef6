// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "semantic/history/home_state.h"
#include "semantic/history/home_store.h"
#include "semantic/query/home_index.h"

namespace oikos::daemon {

/// What small objects are in, on or under that were observed at a pose in `map`, in a home as it stands when a list of observations comes,
/// and as the list itself goes on: a cup may be seen in a drawer that was seen to be open just before. Not thread-safe.
class ObservedPlaces {
 public:
  /// `ids`: of the same home, though its states may be older.
  ObservedPlaces(std::shared_ptr<const semantic::HomeSnapshot> home, const semantic::HomeIndex& ids) : home_(std::move(home)), ids_(ids) {}

  /// semantic::findPlacement() with the object's box. Throws Error{kInput} if the home has no such small object, or the pose is neither at
  /// any furniture nor in any room; `where` says of what.
  [[nodiscard]] semantic::Placement get(const std::string& subject, const semantic::Pose& T_map_object, const std::string& where) const;
  /// Of the same list, ahead of what is asked next.
  void take(const semantic::Event& event);

 private:
  std::shared_ptr<const semantic::HomeSnapshot> home_;
  const semantic::HomeIndex& ids_;
  std::optional<semantic::HomeState> changed_;  // once furniture or a joint is said to have moved
};

}  // namespace oikos::daemon
