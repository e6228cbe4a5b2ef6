// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/time_phrase.h"

#include <gtest/gtest.h>

#include "core/base/rfc3339.h"
#include "semantic/query/words.h"

namespace oikos::semantic {
namespace {

const HomeClock kBerlin("Europe/Berlin", base::parseRfc3339Ns("2026-03-12T18:00:00Z").value());  // Thursday, 19:00

/// "FROM TO" of the stretch, "FROM" of a moment; "nothing" where no time was said.
std::string spanOf(const std::string& text, const HomeClock& clock = kBerlin) {
  const TimeReading reading = readTime(wordsOf(text));
  const auto span = reading.time ? resolveTime(*reading.time, clock, std::nullopt) : std::nullopt;
  if (!span) {
    return "nothing";
  }
  const std::string from = base::toRfc3339(span->from_ns);
  return (span->to_come ? "to come " : "") + (span->from_ns == span->to_ns ? from : from + " " + base::toRfc3339(span->to_ns));
}

TEST(TimePhrase, Moments) {
  EXPECT_EQ(spanOf("yesterday at 8"), "2026-03-11T07:00:00Z");
  EXPECT_EQ(spanOf("at 8:30 yesterday"), "2026-03-11T07:30:00Z");
  EXPECT_EQ(spanOf("yesterday at 7 pm"), "2026-03-11T18:00:00Z");
  EXPECT_EQ(spanOf("today at 7:15am"), "2026-03-12T06:15:00Z");
  EXPECT_EQ(spanOf("on Monday at 8:00"), "2026-03-09T07:00:00Z");
  EXPECT_EQ(spanOf("on 3 March at noon"), "2026-03-03T11:00:00Z");
  EXPECT_EQ(spanOf("on March 3rd, 2025 at midnight"), "2025-03-02T23:00:00Z");
  EXPECT_EQ(spanOf("half past eight yesterday"), "2026-03-11T07:30:00Z");
  EXPECT_EQ(spanOf("at quarter to 9 today"), "2026-03-12T07:45:00Z");
  EXPECT_EQ(spanOf("two hours ago"), "2026-03-12T16:00:00Z");
  EXPECT_EQ(spanOf("half an hour ago"), "2026-03-12T17:30:00Z");
  EXPECT_EQ(spanOf("yesterday at 8 in the evening"), "2026-03-11T19:00:00Z");
}

TEST(TimePhrase, AMomentWithoutItsDayIsTheLastOne) {
  EXPECT_EQ(spanOf("at 8"), "2026-03-12T07:00:00Z");
  EXPECT_EQ(spanOf("at 20:00"), "2026-03-11T19:00:00Z");
  EXPECT_EQ(spanOf("on Thursday at 20:00"), "2026-03-05T19:00:00Z");
  EXPECT_EQ(spanOf("on 24 December"), "2025-12-23T23:00:00Z 2025-12-24T23:00:00Z");
}

TEST(TimePhrase, Stretches) {
  EXPECT_EQ(spanOf("yesterday"), "2026-03-10T23:00:00Z 2026-03-11T23:00:00Z");
  EXPECT_EQ(spanOf("today"), "2026-03-11T23:00:00Z 2026-03-12T18:00:00.000000001Z");
  EXPECT_EQ(spanOf("two days ago"), "2026-03-09T23:00:00Z 2026-03-10T23:00:00Z");
  EXPECT_EQ(spanOf("last Thursday"), "2026-03-04T23:00:00Z 2026-03-05T23:00:00Z");
  EXPECT_EQ(spanOf("on Sunday evening"), "2026-03-08T17:00:00Z 2026-03-08T23:00:00Z");
  EXPECT_EQ(spanOf("last night"), "2026-03-11T19:00:00Z 2026-03-12T05:00:00Z");
  EXPECT_EQ(spanOf("2026-03-10"), "2026-03-09T23:00:00Z 2026-03-10T23:00:00Z");
  EXPECT_EQ(spanOf("last week"), "2026-03-01T23:00:00Z 2026-03-08T23:00:00Z");
}

TEST(TimePhrase, BeforeAndSince) {
  EXPECT_EQ(spanOf("before Wednesday"), "2026-03-10T22:59:59.999999999Z");
  EXPECT_EQ(spanOf("since midnight"), "2026-03-11T23:00:00Z 2026-03-12T18:00:00.000000001Z");
  EXPECT_EQ(spanOf("since yesterday at 18:48"), "2026-03-11T17:48:00Z 2026-03-12T18:00:00.000000001Z");
  EXPECT_EQ(spanOf("in the last two hours"), "2026-03-12T16:00:00Z 2026-03-12T18:00:00.000000001Z");
}

TEST(TimePhrase, TheLongDayOfTheClockChange) {
  const HomeClock november("Europe/Berlin", base::parseRfc3339Ns("2026-10-26T12:00:00Z").value());
  EXPECT_EQ(spanOf("yesterday", november), "2026-10-24T22:00:00Z 2026-10-25T23:00:00Z");  // 25 hours
}

TEST(TimePhrase, WhatIsNoTimeStays) {
  EXPECT_EQ(spanOf("the second drawer on the left"), "nothing");
  EXPECT_EQ(spanOf("on 30 February"), "nothing");
  EXPECT_EQ(spanOf("since the last recording"), "nothing") << "there is none";
  EXPECT_EQ(spanOf("today at 23:00"), "to come 2026-03-12T22:00:00Z");
  EXPECT_EQ(readTime(wordsOf("yesterday where was the cup at 8")).rest, (std::vector<std::string>{"where", "was", "the", "cup"}));
  EXPECT_EQ(readTime(wordsOf("what is the thermostat at")).rest.size(), 5U);
}

}  // namespace
}  // namespace oikos::semantic
