// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/listen_address.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace oikos::daemon {
namespace {

TEST(ListenAddress, ReadsAndWritesHostAndPort) {
  for (const char* const text : {"127.0.0.1:7777", "localhost:0", "[::1]:65535", "0.0.0.0:80"}) {
    EXPECT_EQ(parseListenAddress(text).text(), text);
  }
  EXPECT_EQ(parseListenAddress("[::1]:1").host, "::1");
}

TEST(ListenAddress, RefusesWhatIsNone) {
  for (const char* const text :
       {"", "7777", ":7777", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:65536", "127.0.0.1:-1", "::1:7777", "127.0.0.1:80 "}) {
    test::expectError(base::ErrorCode::kUsage, {"--listen", "127.0.0.1:7777"}, [&] { (void)parseListenAddress(text); });
  }
}

TEST(ListenAddress, KnowsLoopback) {
  for (const char* const host : {"localhost", "127.0.0.1", "127.1.2.3", "::1"}) {
    EXPECT_TRUE(isLoopback(host)) << host;
  }
  for (const char* const host : {"0.0.0.0", "::", "128.0.0.1", "127.0.0.1.example", "192.168.1.1", ""}) {
    EXPECT_FALSE(isLoopback(host)) << host;
  }
}

TEST(ListenAddress, ListensAtAFreePortAndNamesATakenOne) {
  ListenAddress first{"127.0.0.1", 0};
  const base::FileDescriptor listening = listenAt(first);
  EXPECT_GT(first.port, 0);
  ListenAddress second = first;
  test::expectError(base::ErrorCode::kIo, {first.text(), "in use"}, [&] { (void)listenAt(second); });
  ListenAddress nowhere{"no-such-host.invalid", 1};
  test::expectError(base::ErrorCode::kIo, {"no-such-host.invalid:1"}, [&] { (void)listenAt(nowhere); });
}

}  // namespace
}  // namespace oikos::daemon
