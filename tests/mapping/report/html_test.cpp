// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/html.h"

#include <gtest/gtest.h>

namespace oikos::mapping {
namespace {

constexpr const char* kReplacement = "\xEF\xBF\xBD";

TEST(Html, EscapesWhatHasAMeaning) {
  EXPECT_EQ(escapeHtml("<script>alert('1')</script> & \"x\""), "&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt; &amp; &quot;x&quot;");
  EXPECT_EQ(escapeHtml("plain text\twith\nbreaks"), "plain text\twith\nbreaks");
  EXPECT_EQ(escapeHtml(""), "");
}

TEST(Html, KeepsUnicode) {
  EXPECT_EQ(escapeHtml("Küche · 3 m² – 厨房 🍵"), "Küche · 3 m² – 厨房 🍵");
}

TEST(Html, ReplacesBytesThatAreNoText) {
  for (const char* const bytes : {"\x80", "\xFF", "\x01", "\x7F", "\x1B"}) {
    EXPECT_EQ(escapeHtml(std::string("a") + bytes + "b"), std::string("a") + kReplacement + "b");
  }
  EXPECT_EQ(escapeHtml(std::string_view("a\0b", 3)), std::string("a") + kReplacement + "b");
  const std::string cut_off = escapeHtml("caf\xC3");
  EXPECT_EQ(cut_off, std::string("caf") + kReplacement);
}

TEST(Html, ReplacesOverlongFormsSurrogatesAndNonexistentCodePoints) {
  for (const char* const bytes : {"\xC0\xBC", "\xE0\x80\xBC", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC2\x85"}) {
    const std::string escaped = escapeHtml(bytes);
    EXPECT_EQ(escaped.find(bytes), std::string::npos);
    EXPECT_EQ(escaped.substr(0, 3), kReplacement);
  }
}

// RFC 4648, section 10.
TEST(Html, Base64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

}  // namespace
}  // namespace oikos::mapping
