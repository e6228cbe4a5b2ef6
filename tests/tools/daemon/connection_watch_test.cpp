// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/connection_watch.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>

#include "core/base/posix_file.h"

namespace oikos::daemon {
namespace {

using namespace std::chrono_literals;

/// A socket and the end that its client has.
struct Pair {
  Pair() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    ours = base::FileDescriptor(ends[0]);
    theirs = base::FileDescriptor(ends[1]);
  }
  [[nodiscard]] bool isShut() const {
    pollfd handle{theirs.number(), POLLIN, 0};
    return ::poll(&handle, 1, 0) == 1;
  }
  base::FileDescriptor ours{-1};
  base::FileDescriptor theirs{-1};
};

const ConnectionLimits kLimits{3, 30s, 10s, 60s};
const ConnectionWatch::Clock::time_point kStart{};

TEST(ConnectionWatch, ShutsDownWhoIsLate) {
  ConnectionWatch watch(kLimits);
  const Pair waiting;
  const Pair asking;
  const Pair streaming;
  (void)watch.add(waiting.ours.number(), kStart);
  ConnectionWatch::Connection* const request = watch.add(asking.ours.number(), kStart);
  watch.enter(request, ConnectionPhase::kReceiving, kStart + 5s);
  ConnectionWatch::Connection* const stream = watch.add(streaming.ours.number(), kStart);
  watch.enter(stream, ConnectionPhase::kStreaming, kStart);
  watch.enter(request, ConnectionPhase::kAnswering, kStart + 14s);  // the request's clock goes on
  watch.expire(kStart + 15s);
  EXPECT_FALSE(asking.isShut());
  watch.expire(kStart + 15001ms);
  EXPECT_TRUE(asking.isShut());
  watch.expire(kStart + 30s);
  EXPECT_FALSE(waiting.isShut());
  watch.expire(kStart + 30001ms);
  EXPECT_TRUE(waiting.isShut());
  watch.enter(stream, ConnectionPhase::kStreaming, kStart + 50s);
  watch.expire(kStart + 110s);
  EXPECT_FALSE(streaming.isShut());
  EXPECT_EQ(watch.count(), 1U);
  watch.expire(kStart + 110001ms);
  EXPECT_TRUE(streaming.isShut());
  EXPECT_EQ(watch.count(), 0U);
}

TEST(ConnectionWatch, AnsweredInTimeOneMayAskAgain) {
  ConnectionWatch watch(kLimits);
  const Pair pair;
  ConnectionWatch::Connection* const connection = watch.add(pair.ours.number(), kStart);
  for (auto now = kStart; now < kStart + 100s; now += 20s) {
    watch.enter(connection, ConnectionPhase::kReceiving, now);
    watch.enter(connection, ConnectionPhase::kAnswering, now + 8s);
    watch.enter(connection, ConnectionPhase::kWaiting, now + 9s);
    watch.expire(now + 15s);
  }
  EXPECT_FALSE(pair.isShut());
}

TEST(ConnectionWatch, AtTheLimitWhoHasAskedForNothingLongestMakesRoom) {
  ConnectionWatch watch(kLimits);
  const std::array<Pair, 5> pairs;
  std::array<ConnectionWatch::Connection*, 5> connections{};
  for (int i = 0; i < 3; ++i) {
    connections[i] = watch.add(pairs[i].ours.number(), kStart + i * 1s);
  }
  watch.enter(connections[0], ConnectionPhase::kStreaming, kStart);
  watch.enter(connections[1], ConnectionPhase::kReceiving, kStart);
  connections[3] = watch.add(pairs[3].ours.number(), kStart + 3s);
  EXPECT_TRUE(pairs[2].isShut());
  watch.remove(connections[2]);
  watch.enter(connections[3], ConnectionPhase::kReceiving, kStart + 4s);
  connections[4] = watch.add(pairs[4].ours.number(), kStart + 5s);
  EXPECT_TRUE(pairs[1].isShut());
  EXPECT_FALSE(pairs[0].isShut());
  EXPECT_FALSE(pairs[3].isShut());
  EXPECT_EQ(watch.count(), 3U);
  EXPECT_EQ(watch.count(ConnectionPhase::kStreaming), 1U);
}

TEST(ConnectionWatch, WhoHasOnlyJustComeDoesNotMakeRoomForTheNext) {
  ConnectionWatch watch(kLimits);
  const std::array<Pair, 4> pairs;
  std::array<ConnectionWatch::Connection*, 4> connections{};
  for (int i = 0; i < 3; ++i) {
    connections[i] = watch.add(pairs[i].ours.number(), kStart + i * 10ms);
  }
  watch.enter(connections[0], ConnectionPhase::kReceiving, kStart + 5ms);
  watch.enter(connections[1], ConnectionPhase::kReceiving, kStart + 15ms);
  connections[3] = watch.add(pairs[3].ours.number(), kStart + 30ms);
  EXPECT_TRUE(pairs[0].isShut());
  EXPECT_FALSE(pairs[2].isShut());
}

}  // namespace
}  // namespace oikos::daemon
