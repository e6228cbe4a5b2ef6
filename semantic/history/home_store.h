// SPDX-License-Identifier: Apache-2.0
// A home that is kept: home.xml, the history behind it, and the state that both give together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "semantic/history/event.h"
#include "semantic/history/history.h"
#include "semantic/history/recollection.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// The home at one moment. Immutable.
struct HomeSnapshot {
  Home home;                   ///< `as_of`: the last event that it contains
  std::int64_t structure = 0;  ///< grows when anything but states has changed: rooms, objects, labels, words
};

/// The keeper of a home, one per home and machine: an event counts once it is committed to history.sqlite; home.xml follows at checkpoints
/// and is never written over an edit by hand. All methods are thread-safe.
class HomeStore {
 public:
  /// Takes the lock, reads home.xml, notices what was edited by hand since the last checkpoint (which becomes events) and replays the
  /// history. Throws Error{kIo} naming the holder if another process has the lock, Error{kInput} if home.xml is not valid. `now_ns` is the
  /// clock, for what a person edited.
  HomeStore(const std::filesystem::path& folder, std::function<std::int64_t()> now_ns);
  ~HomeStore();  ///< without a checkpoint
  HomeStore(const HomeStore&) = delete;
  HomeStore& operator=(const HomeStore&) = delete;

  /// Readers keep the pointer as long as they like.
  [[nodiscard]] std::shared_ptr<const HomeSnapshot> snapshot() const;
  [[nodiscard]] const History& history() const;
  /// Of the same history; knows at least of every event that the snapshot contains.
  [[nodiscard]] Recollection& recollection() const;

  /// Checks the events against the home (Error{kInput}), fills in `before`, commits them all or none (Error{kIo}: refused, nothing changed)
  /// and returns the last one's number. The snapshot contains them before it returns. What comes from several threads at a time shares one
  /// sync of the disk.
  std::int64_t append(std::vector<Event> events);
  /// Takes up what other processes have committed. Whether there was anything.
  bool refresh();
  /// Reads home.xml again if it is not as it was last written or read: what was edited by hand becomes events. Whether there was anything.
  /// Throws Error{kInput} if it is not valid; nothing has changed then.
  bool reload();
  /// Writes the state back into home.xml if it has changed; an edit by hand is taken up before, one that comes in the moment of the
  /// renaming, too. Readers and writers go on meanwhile. Throws Error{kIo} where it cannot be written, or is edited all the time.
  void checkpoint();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oikos::semantic
