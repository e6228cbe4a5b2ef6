// SPDX-License-Identifier: Apache-2.0
// The stretch of time that a phrase means, by the home's clock.
#include <algorithm>
#include <utility>

#include "semantic/query/time_phrase.h"
#include "semantic/query/time_words.h"

namespace oikos::semantic {

namespace {

/// A day without a year is the last one that is not to come.
std::optional<int> findDay(const DayPhrase& day, const HomeClock& clock) {
  const int today = clock.today();
  if (day.days_ago) {
    return today - *day.days_ago;
  }
  if (day.weekday) {
    const int back = (HomeClock::weekdayOf(today) - *day.weekday + 7) % 7;
    return today - (back == 0 && day.before_today ? 7 : back);
  }
  CalendarDate date = day.date.value_or(CalendarDate{});
  if (date.year != 0) {
    return HomeClock::findDay(date);
  }
  constexpr int kYearsToLeapDay = 8;
  const int year = HomeClock::dateOf(today).year;
  for (date.year = year; date.year >= year - kYearsToLeapDay; --date.year) {
    const auto found = HomeClock::findDay(date);
    if (found && *found <= today) {
      return found;
    }
  }
  return std::nullopt;
}

/// First and last minute of a part of the day, since its midnight; a night ends on the next morning.
std::pair<int, int> minutesOf(DayPart part) {
  switch (part) {
    case DayPart::kMorning:
      return {5 * 60, 12 * 60};
    case DayPart::kAfternoon:
      return {12 * 60, 18 * 60};
    case DayPart::kEvening:
      return {18 * 60, kDayMinutes};
    case DayPart::kNight:
      break;
  }
  return {20 * 60, kDayMinutes + 6 * 60};
}

/// "at 8 in the evening" is 20:00.
int clockMinute(int minute, const std::optional<DayPart>& part) {
  const bool later = part && *part != DayPart::kMorning;
  return minute + (later && minute < kDayMinutes / 2 && minute > 0 ? kDayMinutes / 2 : 0);
}

std::optional<TimeSpan> plainSpan(const TimePhrase& time, const HomeClock& clock) {
  if (time.ago_ns) {
    return TimeSpan{clock.now_ns() - *time.ago_ns, clock.now_ns() - *time.ago_ns, false};
  }
  if (time.weeks_ago) {
    const int monday = clock.today() - (HomeClock::weekdayOf(clock.today()) + 6) % 7 - 7 * *time.weeks_ago;
    return TimeSpan{clock.instantOf({monday, 0}), clock.instantOf({monday + 7, 0}), false};
  }
  const auto day = time.day ? findDay(*time.day, clock) : std::optional(clock.today());
  if (!day) {
    return std::nullopt;
  }
  if (time.minute) {
    const int minute = clockMinute(*time.minute, time.part);
    std::int64_t moment = clock.instantOf({*day, minute});
    const bool may_go_back = !time.day || time.day->weekday;
    if (moment > clock.now_ns() && may_go_back) {
      moment = clock.instantOf({*day - (time.day ? 7 : 1), minute});
    }
    return TimeSpan{moment, moment, false};
  }
  const auto [first, last] = time.part ? minutesOf(*time.part) : std::pair(0, kDayMinutes);
  return TimeSpan{clock.instantOf({*day, first}), clock.instantOf({*day, last}), false};
}

}  // namespace

std::optional<TimeSpan> resolveTime(const TimePhrase& time, const HomeClock& clock, const std::optional<TimeSpan>& last_recording) {
  const auto span = time.last_recording ? last_recording : plainSpan(time, clock);
  if (!span) {
    return std::nullopt;
  }
  TimeSpan result = *span;
  result.to_come = result.from_ns > clock.now_ns();
  if (time.relation == TimeRelation::kBefore) {
    return TimeSpan{result.from_ns - 1, result.from_ns - 1, result.to_come};
  }
  if (time.relation == TimeRelation::kSince) {
    return TimeSpan{result.from_ns, clock.now_ns() + 1, result.to_come};
  }
  result.to_ns = std::min(result.to_ns, std::max(result.from_ns, clock.now_ns() + 1));
  return result;
}

}  // namespace oikos::semantic
