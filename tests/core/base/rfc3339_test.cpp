// SPDX-License-Identifier: Apache-2.0
#include "core/base/rfc3339.h"

#include <gtest/gtest.h>

namespace oikos::base {
namespace {

TEST(Rfc3339, KnownTimes) {
  EXPECT_EQ(parseRfc3339Ns("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(parseRfc3339Ns("2011-05-10T14:07:09.528748Z"), 1305036429528748000);
  EXPECT_EQ(parseRfc3339Ns("2011-05-10 16:07:09.528748+02:00"), 1305036429528748000);
  EXPECT_EQ(parseRfc3339Ns("1969-12-31t23:59:59.25z"), -750000000);
  EXPECT_EQ(parseRfc3339Ns("2024-02-29T00:00:00-00:30"), 1709166600000000000);
}

TEST(Rfc3339, RejectsEverythingElse) {
  for (const char* text : {"", "2024-05-17", "2024-05-17T09:30:00", "2024-13-01T00:00:00Z", "2023-02-29T00:00:00Z", "2024-05-17T25:00:00Z",
                           "2024-05-17T09:30:00+2:00", "2024-05-17T09:30:00.Z", "2024-05-17T09:30:00Z ", "2024-05-17T09:30:00+24:00"}) {
    EXPECT_FALSE(parseRfc3339Ns(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace oikos::base
