// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/access_rules.h"

#include <gtest/gtest.h>

namespace oikos::daemon {
namespace {

TEST(AccessRules, OnLoopbackOnlyItsOwnNamesAreHosts) {
  const AccessRules rules{"127.0.0.1", "secret", false};
  for (const char* const host : {"localhost", "LocalHost:7777", "127.0.0.1", "127.0.0.1:80", "[::1]:7777", "[::1]", "127.0.0.9:1"}) {
    EXPECT_TRUE(rules.allowsHost(host)) << host;
  }
  for (const char* const host : {"", ":7777", "evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "192.168.0.2",
                                 "localhost:x", "localhost:7777:1", "[::1", "[::1]x", "[fe80::1]:7777", "[]", "localhost\n"}) {
    EXPECT_FALSE(rules.allowsHost(host)) << host;
  }
}

TEST(AccessRules, ElsewhereAddressesInDigitsAndTheGivenNameAreHosts) {
  const AccessRules rules{"robot.local", "secret", true};
  for (const char* const host : {"robot.local:7777", "192.168.0.2:7777", "[fe80::1]", "localhost"}) {
    EXPECT_TRUE(rules.allowsHost(host)) << host;
  }
  EXPECT_FALSE(rules.allowsHost("evil.example"));
}

TEST(AccessRules, WritingNeedsTheTokenReadingOnlyWhereOthersMayAsk) {
  const AccessRules home{"127.0.0.1", "secret", false};
  EXPECT_TRUE(home.allows(Access::kRead, ""));
  EXPECT_FALSE(home.allows(Access::kWrite, ""));
  EXPECT_TRUE(home.allows(Access::kWrite, "Bearer secret"));
  EXPECT_TRUE(home.allows(Access::kWrite, "bearer secret"));
  for (const char* const wrong :
       {"secret", "Bearer", "Bearer ", "Bearer secre", "Bearer secrets", "Bearer secretsecret", "Basic secret", "Bearer Secret"}) {
    EXPECT_FALSE(home.allows(Access::kWrite, wrong)) << wrong;
  }
  const AccessRules network{"0.0.0.0", "secret", true};
  EXPECT_TRUE(network.allows(Access::kOpen, ""));
  EXPECT_FALSE(network.allows(Access::kRead, ""));
  EXPECT_TRUE(network.allows(Access::kRead, "Bearer secret"));
}

TEST(AccessRules, WithoutATokenNobodyWrites) {
  EXPECT_FALSE((AccessRules{"127.0.0.1", "", false}.allows(Access::kWrite, "Bearer ")));
}

}  // namespace
}  // namespace oikos::daemon
