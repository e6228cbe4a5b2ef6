// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/request_target.h"

#include <gtest/gtest.h>

#include <string>

namespace oikos::daemon {
namespace {

using Path = std::vector<std::string>;

TEST(RequestTarget, SplitsBeforeItDecodes) {
  const auto target = parseRequestTarget("/v1/objects/a%2Fb%20c+d/history?q=where+is%3F&empty=&bare&q=second");
  ASSERT_TRUE(target.has_value());
  EXPECT_EQ(target->path, (Path{"v1", "objects", "a/b c+d", "history"}));
  EXPECT_EQ(target->find("q"), "where is?");
  EXPECT_EQ(target->find("empty"), "");
  EXPECT_EQ(target->find("bare"), "");
  EXPECT_EQ(target->find("other"), std::nullopt);
}

TEST(RequestTarget, KeepsEmptySegmentsDotsAndNuls) {
  EXPECT_EQ(parseRequestTarget("/")->path, Path{});
  EXPECT_EQ(parseRequestTarget("//a/../b")->path, (Path{"", "a", "..", "b"}));
  EXPECT_EQ(parseRequestTarget("/?q=a%00b")->find("q"), std::string_view("a\0b", 3));
}

TEST(RequestTarget, RefusesWhatIsNoTarget) {
  for (const char* const wrong : {"", "v1", "http://elsewhere/v1", "/%", "/%4", "/%zz", "/%+4", "/a?%x1=1", "/a?b=%", "*"}) {
    EXPECT_FALSE(parseRequestTarget(wrong).has_value()) << wrong;
  }
}

}  // namespace
}  // namespace oikos::daemon
