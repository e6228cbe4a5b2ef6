// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace oikos::daemon {

/// Some events as server-sent events, in the order of their numbers; empty: there are none.
struct EventBatch {
  std::string text;
  std::int64_t last = 0;  ///< number of the last one in it
};

/// The clients that are being sent events. They hold no events: each has the number of the last one it was given and fetches the next when
/// its connection can take them. All methods are thread-safe, but one stream is read by one thread at a time.
class EventStreams {
 public:
  using Clock = std::chrono::steady_clock;
  using Source = std::function<EventBatch(std::int64_t after)>;

  /// What the stream's connection does; both are called with the lock of all streams held.
  struct Connection {
    int socket = -1;
    std::function<void()> suspend;  ///< read() is not called until
    std::function<void()> resume;
  };

  struct Stream {
    Connection connection;
    std::int64_t after = 0;
    std::string pending;     ///< of this stream's reader
    std::size_t sent = 0;    ///< of `pending`
    bool suspended = false;  ///< these are of all threads, under the lock
    bool woken = false;
    bool beat = false;
    Clock::time_point fetched_at;
    std::list<Stream>::iterator self;
  };

  EventStreams(std::size_t most, Source source) : most_(most), source_(std::move(source)) {}

  /// Null: there are as many as may be.
  [[nodiscard]] Stream* open(std::int64_t after, Connection connection, Clock::time_point now);
  void close(Stream* stream);
  /// Fills the buffer; 0: nothing yet, the connection is suspended; nothing: the stream ends here.
  [[nodiscard]] std::optional<std::size_t> read(Stream* stream, std::span<char> buffer, Clock::time_point now);

  /// There are new events.
  void wake();
  /// Wakes the streams whose client is gone, and those that were silent for long, so that theirs is noticed.
  void tick(Clock::time_point now);
  /// Ends all streams; no further ones are opened.
  void stop();
  [[nodiscard]] std::size_t count() const;

 private:
  bool fill(Stream& stream, Clock::time_point now);
  static void resume(Stream& stream);

  const std::size_t most_;
  const Source source_;
  mutable std::mutex mutex_;
  bool stopping_ = false;
  std::list<Stream> streams_;
};

}  // namespace oikos::daemon
