// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "semantic/history/event.h"
#include "semantic/history/history.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// A home whose states change, and where in it every subject of an event is. Not thread-safe.
class HomeState {
 public:
  explicit HomeState(Home home);

  [[nodiscard]] const Home& home() const { return home_; }
  void setAsOf(std::int64_t number) { home_.as_of = number; }

  /// Nothing: no such subject.
  [[nodiscard]] std::optional<State> findState(std::string_view subject) const;
  /// Throws Error{kInput} unless the event tells of something in this home and its state is one that its subject can have.
  void check(const Event& event) const;
  /// One event that the history contains already. What is newer than it stays.
  void apply(const Event& event, const History& history);
  /// Every event that was committed after the home's `as_of`, which becomes the last one's number. `taken` is told of each.
  void takeNewFrom(const History& history, const std::function<void(const Event&)>& taken = {});

  /// A state that is none of this subject, or a subject that is not there, is passed over: home.xml was edited since.
  void set(const std::string& subject, const State& state);
  /// When a small object was seen last, and how surely.
  void setSeen(const std::string& subject, const std::optional<Event>& sighting);

 private:
  enum class Kind { kObject, kJoint, kKnob, kSmallObject, kPart, kRoom };
  struct Location {
    Kind kind = Kind::kObject;
    std::size_t room = 0;
    std::optional<std::size_t> object;  ///< of the room; nothing: on its floor
  };

  void collect(std::size_t room, std::size_t object);
  void checkState(const Event& event, const Location& location) const;
  void takeFrom(const History& history, const std::string& subject);
  void setPlacement(const std::string& subject, const Placement& placement);
  [[nodiscard]] const LargeObject& objectAt(const Location& location) const;
  [[nodiscard]] LargeObject& editObjectAt(const Location& location);
  /// Those that the furniture carries, or that lie on the room's floor; the furniture becomes a copy of its own.
  [[nodiscard]] std::vector<SmallObject>& editCarriedAt(const Location& location);
  [[nodiscard]] const std::vector<SmallObject>& carriedAt(const Location& location) const;

  Home home_;
  // looked up only, never walked through
  std::unordered_map<std::string, Location> locations_;
  std::unordered_map<std::string, std::int64_t> newest_ns_;  // of the states that are in the home
};

/// Makes events ready to be committed: each is checked against the home (Error{kInput}), its `after` is as it will be stored, and `before`
/// is what the home has, or what the events before it make of it. `changed`: that, of earlier events that are to be committed with these;
/// it is not touched where an error is thrown.
void prepareForCommit(std::vector<Event>& events, const HomeState& state, std::map<std::string, State>& changed);

/// home.xml as it stands in the folder with every event that came after it. Takes no lock and writes nothing. Throws Error{kInput} for a
/// home that is not valid.
[[nodiscard]] Home loadHome(const std::filesystem::path& folder);

/// The home as it was at `time_ns`: the states that the history had by then; where it has none, that from before the first change, else
/// that of `current`. What stands in `current` and is no state (labels, models, shapes) stays. O(k log n) for k subjects with a history.
[[nodiscard]] Home homeAt(const Home& current, const History& history, std::int64_t time_ns);

}  // namespace oikos::semantic
