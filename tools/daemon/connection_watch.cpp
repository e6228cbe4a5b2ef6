// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/connection_watch.h"

#include <sys/socket.h>

#include <algorithm>
#include <tuple>

namespace oikos::daemon {

namespace {

constexpr std::chrono::milliseconds kJustCome{500};

/// Whoever closes the socket notices, wherever it waits; the number stays taken until then.
void shut(ConnectionWatch::Connection& connection) {
  if (!connection.shut) {
    connection.shut = true;
    ::shutdown(connection.socket, SHUT_RDWR);
  }
}

}  // namespace

ConnectionWatch::Connection* ConnectionWatch::add(int socket, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (open() >= limits_.connections) {
    makeRoom(now);
  }
  connections_.push_back({socket, ConnectionPhase::kWaiting, now, false, {}});
  connections_.back().self = std::prev(connections_.end());
  return &connections_.back();
}

void ConnectionWatch::remove(Connection* connection) {
  const std::lock_guard lock(mutex_);
  connections_.erase(connection->self);
}

void ConnectionWatch::enter(Connection* connection, ConnectionPhase phase, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (phase != ConnectionPhase::kAnswering) {
    connection->since = now;
  }
  connection->phase = phase;
}

void ConnectionWatch::expire(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (Connection& connection : connections_) {
    if (isLate(connection, now)) {
      shut(connection);
    }
  }
}

std::size_t ConnectionWatch::count() const {
  const std::lock_guard lock(mutex_);
  return open();
}

std::size_t ConnectionWatch::count(ConnectionPhase phase) const {
  const std::lock_guard lock(mutex_);
  return std::count_if(connections_.begin(), connections_.end(),
                       [phase](const Connection& connection) { return connection.phase == phase && !connection.shut; });
}

std::size_t ConnectionWatch::open() const {
  return std::count_if(connections_.begin(), connections_.end(), [](const Connection& connection) { return !connection.shut; });
}

/// Who has sent no request makes room first, then who has sent a part of one, then who takes its time to read; the longest wait counts. Who
/// has only just come goes last: its request may be on its way.
void ConnectionWatch::makeRoom(Clock::time_point now) {
  const auto rank = [now](const Connection& connection) {
    const bool has_just_come = connection.phase == ConnectionPhase::kWaiting && now - connection.since < kJustCome;
    return std::tuple(has_just_come, connection.phase, connection.since);
  };
  Connection* last = nullptr;
  for (Connection& connection : connections_) {
    const bool may_go = !connection.shut && connection.phase != ConnectionPhase::kStreaming;
    if (may_go && (last == nullptr || rank(connection) < rank(*last))) {
      last = &connection;
    }
  }
  if (last != nullptr) {
    shut(*last);
  }
}

bool ConnectionWatch::isLate(const Connection& connection, Clock::time_point now) const {
  switch (connection.phase) {
    case ConnectionPhase::kWaiting:
      return now - connection.since > limits_.waiting;
    case ConnectionPhase::kStreaming:
      return now - connection.since > limits_.stalled;
    default:
      return now - connection.since > limits_.request;
  }
}

}  // namespace oikos::daemon
