// SPDX-License-Identifier: Apache-2.0
// Who is connected, since when, and what for: the clock that a client cannot stop by sending or taking one byte now and then.
#pragma once

#include <chrono>
#include <cstddef>
#include <list>
#include <mutex>

namespace oikos::daemon {

enum class ConnectionPhase {
  kWaiting,    ///< no request line yet, or none since the last answer
  kReceiving,  ///< the request is not complete
  kAnswering,  ///< it is; the answer is being made or sent
  kStreaming,  ///< events are being sent
};

struct ConnectionLimits {
  std::size_t connections = 512;
  std::chrono::milliseconds waiting{30'000};  ///< for a request line
  std::chrono::milliseconds request{10'000};  ///< from its line to the end of its answer
  std::chrono::milliseconds stalled{30'000};  ///< a stream that takes nothing
};

/// Shuts sockets down that are late, and at the limit of connections the one that has kept others waiting longest. All methods are
/// thread-safe.
class ConnectionWatch {
 public:
  using Clock = std::chrono::steady_clock;
  struct Connection {
    int socket = -1;
    ConnectionPhase phase = ConnectionPhase::kWaiting;
    Clock::time_point since;  ///< the beginning of the wait, of the request, of the stream's latest progress
    bool shut = false;
    std::list<Connection>::iterator self;
  };

  explicit ConnectionWatch(const ConnectionLimits& limits) : limits_(limits) {}

  /// The socket stays the caller's, who calls remove() before closing it.
  [[nodiscard]] Connection* add(int socket, Clock::time_point now);
  void remove(Connection* connection);
  /// A request's clock goes on from kReceiving to kAnswering; each other phase starts its own.
  void enter(Connection* connection, ConnectionPhase phase, Clock::time_point now);
  /// Shuts down whoever is late.
  void expire(Clock::time_point now);

  /// Without those that were shut down.
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] std::size_t count(ConnectionPhase phase) const;

 private:
  [[nodiscard]] std::size_t open() const;
  void makeRoom(Clock::time_point now);
  [[nodiscard]] bool isLate(const Connection& connection, Clock::time_point now) const;

  const ConnectionLimits limits_;
  mutable std::mutex mutex_;
  std::list<Connection> connections_;
};

}  // namespace oikos::daemon
