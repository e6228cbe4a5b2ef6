// SPDX-License-Identifier: Apache-2.0
// The clock on a home's wall: instants as its people call them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace oikos::semantic {

/// A moment on that clock.
struct WallTime {
  int day = 0;     ///< since 1970-01-01
  int minute = 0;  ///< since midnight
};

struct CalendarDate {
  int year = 1970;
  int month = 1;
  int day = 1;
};

class HomeClock {
 public:
  /// A zone that the machine's tz database lacks counts as UTC. Never throws. A look at the database is put off until it is needed.
  HomeClock(std::string time_zone, std::int64_t now_ns) : time_zone_(std::move(time_zone)), now_ns_(now_ns) {}

  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }
  [[nodiscard]] int today() const { return wallTime(now_ns_).day; }
  [[nodiscard]] WallTime wallTime(std::int64_t time_ns) const;
  /// A time that the clock shows twice is the first of both; one that it skips is the moment of the jump.
  [[nodiscard]] std::int64_t instantOf(WallTime time) const;
  /// "18:50".
  [[nodiscard]] std::string timeText(std::int64_t time_ns) const;
  /// "today", "yesterday", "on Monday" within the last week, else "on 28 February", with its year if it is another than now.
  [[nodiscard]] std::string dayText(std::int64_t time_ns) const;
  /// "on Monday at 8:00".
  [[nodiscard]] std::string text(std::int64_t time_ns) const { return dayText(time_ns) + " at " + timeText(time_ns); }

  /// Nothing: there is no such date.
  [[nodiscard]] static std::optional<int> findDay(const CalendarDate& date);
  [[nodiscard]] static CalendarDate dateOf(int day);
  /// 0: Sunday.
  [[nodiscard]] static int weekdayOf(int day);

 private:
  std::string time_zone_;
  std::int64_t now_ns_;
};

}  // namespace oikos::semantic
