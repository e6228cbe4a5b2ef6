// SPDX-License-Identifier: Apache-2.0
// The log of everything that was observed in a home and of every change: HOME/history.sqlite, append only. An event counts once its commit
// is on the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semantic/history/event.h"

namespace oikos::semantic {

enum class HistoryAccess { kRead, kAppend };

/// One open log. All methods are thread-safe; all throw Error{kIo} if the file cannot be read or written. A recording is taken back by an
/// event `reverted` that names it: what it had said before no longer counts, except in the order of commits. Evidence that an event
/// `forgotten` names is left out of every event before it.
class History {
 public:
  /// kAppend creates the file if it is missing; kRead takes a missing one as empty. Throws Error{kInput} for a file that is no history or
  /// of a newer version.
  History(const std::filesystem::path& file, HistoryAccess access);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// home.xml as it is on the disk, or about to be.
  struct Checkpoint {
    std::int64_t as_of = 0;
    std::string content;
  };

  /// Commits the events in their order, and the checkpoint with them, all or none, and returns the number of the last. They are on the disk
  /// when it returns. Their own numbers are ignored. Of checkpoints the last two are kept.
  std::int64_t append(std::span<const Event> events, const Checkpoint* checkpoint = nullptr);
  /// The newest first.
  [[nodiscard]] std::vector<Checkpoint> checkpoints() const;

  /// A recording that was read to its end.
  struct ReadRecording {
    std::string digest;         ///< of its content
    std::string recording;      ///< its name in events
    std::int64_t first_ns = 0;  ///< time of its first frame
    std::int64_t last_ns = 0;   ///< and of its last one
  };
  /// Commits what a recording says, and that it was read, all or none. Nothing if its content was read before, by whatever name, and not
  /// taken back since: nothing is written then.
  std::optional<std::int64_t> appendRecording(const ReadRecording& read, std::span<const Event> events);
  /// How this content was read last. Needs kAppend.
  struct ReadBefore {
    std::string recording;  ///< its name in events
    bool counts = true;     ///< it was not taken back since
  };
  [[nodiscard]] std::optional<ReadBefore> findReadRecording(std::string_view digest) const;

  /// Of the last event; 0: none yet. Sees what other processes have committed.
  [[nodiscard]] std::int64_t lastNumber() const;
  /// In the order of commits, numbers above `number`; at most `limit`.
  [[nodiscard]] std::vector<Event> eventsAfter(std::int64_t number, std::size_t limit) const;
  /// In the order of time, then of commits. Without what was taken back.
  [[nodiscard]] std::vector<Event> eventsOf(std::string_view subject) const;
  /// The newest by `time_ns`, at most `limit`; in the same order, each without its `before`: quicker to read by a third.
  [[nodiscard]] std::vector<Event> lastEventsOf(std::string_view subject, std::int64_t time_ns, std::size_t limit) const;
  /// With from_ns <= time_ns < to_ns, in the order of time, then of commits, `limit` of them from the one numbered `offset` on. Without
  /// what was taken back.
  struct Window {
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
    std::size_t offset = 0;
    std::size_t limit = std::numeric_limits<std::size_t>::max();
  };
  [[nodiscard]] std::vector<Event> eventsBetween(const Window& window) const;
  /// How many there are in the window's time.
  [[nodiscard]] std::size_t countBetween(std::int64_t from_ns, std::int64_t to_ns) const;
  /// The newest at `time_ns` that says something about the subject's state; nothing: it had said nothing by then. O(log n).
  [[nodiscard]] std::optional<Event> findStateAt(std::string_view subject, std::int64_t time_ns) const;
  /// The first after `time_ns` that does. O(log n).
  [[nodiscard]] std::optional<Event> findStateAfter(std::string_view subject, std::int64_t time_ns) const;
  /// The newest sighting by `time_ns`.
  [[nodiscard]] std::optional<Event> findSightingAt(std::string_view subject, std::int64_t time_ns) const;
  /// In the order of commits. Without what was taken back, and without the taking back.
  [[nodiscard]] std::vector<Event> eventsOfRecording(std::string_view recording) const;
  /// The newest observation that says something about the subject's state, as if the recording and all taking back had never been.
  [[nodiscard]] std::optional<Event> findStateWithout(std::string_view subject, std::string_view recording) const;
  /// The first that was ever committed of the subject's state, also if it was taken back: its `before` is what was there at the start.
  [[nodiscard]] std::optional<Event> findFirstState(std::string_view subject) const;
  /// Every subject that a state was ever said of, in alphabetical order.
  [[nodiscard]] std::vector<std::string> subjects() const;
  /// Every recording that ever said something, in alphabetical order; also those that were taken back.
  [[nodiscard]] std::vector<std::string> recordings() const;
  /// The recording with the latest event, and the times of its first and last event; or a later one that was read to its end, whatever it
  /// changed, and the times of its frames. Nothing: no recording yet.
  struct RecordingSpan {
    std::string recording;
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;
  };
  [[nodiscard]] std::optional<RecordingSpan> findLastRecording() const;

 private:
  class Database;
  std::unique_ptr<Database> database_;
};

}  // namespace oikos::semantic
