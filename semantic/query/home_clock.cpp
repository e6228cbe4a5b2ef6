// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/home_clock.h"

#include <date/tz.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>

#include "core/base/number_text.h"

namespace oikos::semantic {

namespace {

/// Null: neither the zone nor UTC can be found.
const date::time_zone* zoneOf(const std::string& name) {
  for (const std::string& candidate : {name, std::string("UTC")}) {
    try {
      return date::locate_zone(candidate);
    } catch (const std::exception&) {
      continue;
    }
  }
  return nullptr;
}

date::sys_seconds secondsOf(std::int64_t time_ns) {
  return date::floor<std::chrono::seconds>(date::sys_time<std::chrono::nanoseconds>(std::chrono::nanoseconds(time_ns)));
}

std::string twoDigits(int number) {
  return (number < 10 ? "0" : "") + base::toText(static_cast<std::int64_t>(number));
}

constexpr std::array<const char*, 7> kWeekdays{"Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday"};
constexpr std::array<const char*, 12> kMonths{"January", "February", "March",     "April",   "May",      "June",
                                              "July",    "August",   "September", "October", "November", "December"};

}  // namespace

WallTime HomeClock::wallTime(std::int64_t time_ns) const {
  const date::time_zone* zone = zoneOf(time_zone_);
  const date::sys_seconds utc = secondsOf(time_ns);
  const auto local = zone == nullptr ? date::local_seconds(utc.time_since_epoch()) : zone->to_local(utc);
  const auto day = date::floor<date::days>(local);
  const auto minute = std::chrono::duration_cast<std::chrono::minutes>(local - day);
  return {static_cast<int>(day.time_since_epoch().count()), static_cast<int>(minute.count())};
}

std::int64_t HomeClock::instantOf(WallTime time) const {
  const date::time_zone* zone = zoneOf(time_zone_);
  const date::local_seconds local{date::days(time.day) + std::chrono::minutes(time.minute)};
  const auto utc = zone == nullptr ? date::sys_seconds(local.time_since_epoch()) : zone->to_sys(local, date::choose::earliest);
  return std::chrono::nanoseconds(utc.time_since_epoch()).count();
}

std::string HomeClock::timeText(std::int64_t time_ns) const {
  const int minute = wallTime(time_ns).minute;
  return base::toText(static_cast<std::int64_t>(minute / 60)) + ":" + twoDigits(minute % 60);
}

std::string HomeClock::dayText(std::int64_t time_ns) const {
  const int day = wallTime(time_ns).day;
  const int now = today();
  if (day == now) {
    return "today";
  }
  if (day == now - 1) {
    return "yesterday";
  }
  if (day < now && day > now - 7) {
    return std::string("on ") + kWeekdays[static_cast<std::size_t>(weekdayOf(day))];
  }
  const CalendarDate date = dateOf(day);
  const std::string year = date.year == dateOf(now).year ? "" : " " + base::toText(static_cast<std::int64_t>(date.year));
  return "on " + base::toText(static_cast<std::int64_t>(date.day)) + " " + kMonths[static_cast<std::size_t>(date.month - 1)] + year;
}

std::optional<int> HomeClock::findDay(const CalendarDate& date) {
  constexpr int kFirstYear = 1700;
  constexpr int kLastYear = 2200;  // what nanoseconds since 1970 can say
  if (date.month < 1 || date.day < 1 || date.year < kFirstYear || date.year > kLastYear) {
    return std::nullopt;
  }
  const date::year_month_day day{date::year(date.year), date::month(static_cast<unsigned>(date.month)),
                                 date::day(static_cast<unsigned>(date.day))};
  return day.ok() ? std::optional(static_cast<int>(date::sys_days(day).time_since_epoch().count())) : std::nullopt;
}

CalendarDate HomeClock::dateOf(int day) {
  const date::year_month_day date{date::sys_days(date::days(day))};
  return {static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day()))};
}

int HomeClock::weekdayOf(int day) {
  return static_cast<int>(date::weekday(date::sys_days(date::days(day))).c_encoding());
}

}  // namespace oikos::semantic
