// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "semantic/query/home_clock.h"

namespace oikos::semantic {

enum class TimeRelation { kAt, kBefore, kSince };

enum class DayPart { kMorning, kAfternoon, kEvening, kNight };

/// "yesterday", "on Monday", "on 3 March": one of these.
struct DayPhrase {
  std::optional<int> days_ago;
  std::optional<int> weekday;        ///< 0: Sunday
  bool before_today = false;         ///< of a weekday: "last Monday" is not today
  std::optional<CalendarDate> date;  ///< year 0: the last such day
};

/// A time as it was said. It is known with the present and the home's clock only.
struct TimePhrase {
  TimeRelation relation = TimeRelation::kAt;
  std::optional<DayPhrase> day;
  std::optional<int> minute;  ///< since midnight
  std::optional<DayPart> part;
  std::optional<std::int64_t> ago_ns;
  std::optional<int> weeks_ago;  ///< a whole week; 0: this one
  bool last_recording = false;
  std::string words;
};

struct TimeReading {
  std::optional<TimePhrase> time;
  std::vector<std::string> rest;  ///< the words that belong to no time
};

/// Takes every piece of a time out of a question's words, wherever it stands: "yesterday where was the cup at 8".
[[nodiscard]] TimeReading readTime(const std::vector<std::string>& words);

/// A stretch of time; from_ns = to_ns: a moment. What is to come is cut off.
struct TimeSpan {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;  ///< not part of it, if it is a stretch
  bool to_come = false;    ///< it begins after now

  /// The moment whose state answers a question about the whole.
  [[nodiscard]] std::int64_t last_ns() const { return to_ns > from_ns ? to_ns - 1 : to_ns; }
};

/// `last_recording`: its first and last moment. Nothing: no such date, or no recording yet. `relation` before T: the moment before; since
/// T: from then to now.
[[nodiscard]] std::optional<TimeSpan> resolveTime(const TimePhrase& time, const HomeClock& clock,
                                                  const std::optional<TimeSpan>& last_recording);

}  // namespace oikos::semantic
