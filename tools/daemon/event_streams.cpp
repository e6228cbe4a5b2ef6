// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/event_streams.h"

#include <poll.h>

#include <algorithm>

namespace oikos::daemon {

namespace {

constexpr std::chrono::seconds kSilence{5};
constexpr const char* kGreeting = "retry: 1000\n\n";
constexpr const char* kBeat = ":\n\n";

/// The client has closed its side, or the socket was shut down.
bool isGone(int socket) {
  pollfd handle{socket, POLLRDHUP, 0};
  return ::poll(&handle, 1, 0) == 1 && (handle.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

}  // namespace

EventStreams::Stream* EventStreams::open(std::int64_t after, Connection connection, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || streams_.size() >= most_) {
    return nullptr;
  }
  Stream& stream = streams_.emplace_back();
  stream.connection = std::move(connection);
  stream.after = after;
  stream.pending = kGreeting;
  stream.fetched_at = now;
  stream.self = std::prev(streams_.end());
  return &stream;
}

void EventStreams::close(Stream* stream) {
  const std::lock_guard lock(mutex_);
  streams_.erase(stream->self);
}

std::optional<std::size_t> EventStreams::read(Stream* stream, std::span<char> buffer, Clock::time_point now) {
  if (stream->sent == stream->pending.size() && !fill(*stream, now)) {
    const std::lock_guard lock(mutex_);
    return stopping_ ? std::nullopt : std::optional<std::size_t>(0);
  }
  const std::size_t size = std::min(buffer.size(), stream->pending.size() - stream->sent);
  std::copy_n(stream->pending.begin() + static_cast<std::ptrdiff_t>(stream->sent), size, buffer.begin());
  stream->sent += size;
  return size;
}

/// False: there is nothing to send, and the stream is suspended or ends.
bool EventStreams::fill(Stream& stream, Clock::time_point now) {
  stream.sent = 0;
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      stream.woken = false;
    }
    EventBatch batch = source_(stream.after);
    const std::lock_guard lock(mutex_);
    stream.pending = std::move(batch.text);
    if (!stream.pending.empty()) {
      stream.after = batch.last;
    } else if (stream.beat && !stopping_) {
      stream.pending = kBeat;
    } else if (stream.woken && !stopping_) {
      continue;  // something came between the look and the lock
    } else {
      stream.suspended = !stopping_;
      if (stream.suspended) {
        stream.connection.suspend();
      }
      return false;
    }
    stream.beat = false;
    stream.fetched_at = now;
    return true;
  }
}

void EventStreams::wake() {
  const std::lock_guard lock(mutex_);
  for (Stream& stream : streams_) {
    stream.woken = true;
    resume(stream);
  }
}

void EventStreams::tick(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (Stream& stream : streams_) {
    if (stream.suspended && (now - stream.fetched_at > kSilence || isGone(stream.connection.socket))) {
      stream.beat = true;
      resume(stream);
    }
  }
}

void EventStreams::stop() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  for (Stream& stream : streams_) {
    resume(stream);
  }
}

std::size_t EventStreams::count() const {
  const std::lock_guard lock(mutex_);
  return streams_.size();
}

void EventStreams::resume(Stream& stream) {
  if (stream.suspended) {
    stream.suspended = false;
    stream.connection.resume();
  }
}

}  // namespace oikos::daemon
