// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/home_clock.h"

#include <gtest/gtest.h>

#include "core/base/rfc3339.h"

namespace oikos::semantic {
namespace {

std::int64_t at(const char* text) {
  return base::parseRfc3339Ns(text).value();
}

int dayOf(int year, int month, int day) {
  return HomeClock::findDay({year, month, day}).value();
}

TEST(HomeClock, WinterAndSummerInBerlin) {
  const HomeClock clock("Europe/Berlin", at("2026-03-12T18:00:00Z"));
  EXPECT_EQ(clock.instantOf({dayOf(2026, 3, 9), 8 * 60}), at("2026-03-09T07:00:00Z"));
  EXPECT_EQ(clock.instantOf({dayOf(2026, 7, 9), 8 * 60}), at("2026-07-09T06:00:00Z"));
  EXPECT_EQ(clock.timeText(at("2026-03-11T17:50:00Z")), "18:50");
  EXPECT_EQ(clock.timeText(at("2026-07-11T17:05:00Z")), "19:05");
}

TEST(HomeClock, ASkippedTimeIsTheJumpAndADoubleOneTheFirst) {
  const HomeClock clock("Europe/Berlin", at("2026-11-12T18:00:00Z"));
  EXPECT_EQ(clock.instantOf({dayOf(2026, 3, 29), 2 * 60 + 30}), at("2026-03-29T01:00:00Z"));  // 2:00 is 3:00
  EXPECT_EQ(clock.instantOf({dayOf(2026, 3, 29), 3 * 60}), at("2026-03-29T01:00:00Z"));
  EXPECT_EQ(clock.instantOf({dayOf(2026, 10, 25), 2 * 60 + 30}), at("2026-10-25T00:30:00Z"));  // again at 01:30Z
  EXPECT_EQ(clock.instantOf({dayOf(2026, 10, 25), 3 * 60}), at("2026-10-25T02:00:00Z"));
}

TEST(HomeClock, DaysByTheirNames) {
  const HomeClock clock("Europe/Berlin", at("2026-03-12T18:00:00Z"));  // a Thursday
  EXPECT_EQ(clock.text(at("2026-03-12T06:30:00Z")), "today at 7:30");
  EXPECT_EQ(clock.dayText(at("2026-03-11T23:30:00Z")), "today") << "it is 0:30 in Berlin";
  EXPECT_EQ(clock.dayText(at("2026-03-11T22:30:00Z")), "yesterday");
  EXPECT_EQ(clock.dayText(at("2026-03-06T12:00:00Z")), "on Friday");
  EXPECT_EQ(clock.dayText(at("2026-03-05T12:00:00Z")), "on 5 March");
  EXPECT_EQ(clock.dayText(at("2025-12-31T12:00:00Z")), "on 31 December 2025");
  EXPECT_EQ(HomeClock::weekdayOf(clock.today()), 4);
}

TEST(HomeClock, AnUnknownZoneIsUtcAndAnImpossibleDateNone) {
  EXPECT_EQ(HomeClock("Mars/Olympus", 0).timeText(at("2026-03-11T17:50:00Z")), "17:50");
  EXPECT_FALSE(HomeClock::findDay({2026, 2, 29}));
  EXPECT_TRUE(HomeClock::findDay({2028, 2, 29}));
  EXPECT_FALSE(HomeClock::findDay({2026, 13, 1}));
}

}  // namespace
}  // namespace oikos::semantic
