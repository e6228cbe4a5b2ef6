// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/time_phrase.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "core/base/number_text.h"

namespace oikos::semantic {

namespace {

constexpr std::int64_t kMinute_ns = 60'000'000'000;
constexpr int kDayMinutes = 24 * 60;

template <std::size_t N>
std::optional<int> findIn(const std::array<std::string_view, N>& names, std::string_view word) {
  const auto found = std::find(names.begin(), names.end(), word);
  return found == names.end() ? std::nullopt : std::optional(static_cast<int>(found - names.begin()));
}

std::optional<int> weekdayNamed(std::string_view word) {
  static constexpr std::array<std::string_view, 7> names{"sunday", "monday", "tuesday", "wednesday", "thursday", "friday", "saturday"};
  return findIn(names, word);
}

std::optional<int> monthNamed(std::string_view word) {
  static constexpr std::array<std::string_view, 12> names{"january", "february", "march",     "april",   "may",      "june",
                                                          "july",    "august",   "september", "october", "november", "december"};
  const auto found = findIn(names, word);
  return found ? std::optional(*found + 1) : std::nullopt;
}

std::optional<int> wholeNumber(std::string_view digits) {
  constexpr std::size_t kMostDigits = 6;
  int number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') {
      return std::nullopt;
    }
    number = 10 * number + (c - '0');
    if (digits.size() > kMostDigits) {
      return std::nullopt;
    }
  }
  return digits.empty() ? std::nullopt : std::optional(number);
}

/// "3", "three", "a".
std::optional<int> countNamed(std::string_view word) {
  static constexpr std::array<std::string_view, 13> names{"zero",  "one",   "two",  "three", "four",   "five",  "six",
                                                          "seven", "eight", "nine", "ten",   "eleven", "twelve"};
  if (word == "a" || word == "an") {
    return 1;
  }
  const auto named = findIn(names, word);
  return named ? named : wholeNumber(word);
}

/// "3", "3rd".
std::optional<int> dayOfMonth(std::string_view word) {
  for (const std::string_view ending : {"st", "nd", "rd", "th"}) {
    if (word.size() > 2 && word.ends_with(ending)) {
      word.remove_suffix(2);
      break;
    }
  }
  const auto day = wholeNumber(word);
  return day && *day >= 1 && *day <= 31 ? day : std::nullopt;
}

/// "2026-03-10".
std::optional<CalendarDate> isoDate(std::string_view word) {
  if (word.size() != 10 || word[4] != '-' || word[7] != '-') {
    return std::nullopt;
  }
  const auto year = wholeNumber(word.substr(0, 4));
  const auto month = wholeNumber(word.substr(5, 2));
  const auto day = wholeNumber(word.substr(8, 2));
  return year && month && day ? std::optional(CalendarDate{*year, *month, *day}) : std::nullopt;
}

std::optional<std::int64_t> unitNs(std::string_view word) {
  if (word.ends_with('s')) {
    word.remove_suffix(1);
  }
  if (word == "minute" || word == "min") {
    return kMinute_ns;
  }
  return word == "hour" ? std::optional(60 * kMinute_ns) : std::nullopt;
}

std::optional<int> unitDays(std::string_view word) {
  if (word.ends_with('s')) {
    word.remove_suffix(1);
  }
  return word == "day" ? std::optional(1) : word == "week" ? std::optional(7) : std::nullopt;
}

std::optional<DayPart> partNamed(std::string_view word) {
  static constexpr std::array<std::string_view, 4> names{"morning", "afternoon", "evening", "night"};
  const auto part = findIn(names, word);
  return part ? std::optional(static_cast<DayPart>(*part)) : std::nullopt;
}

/// Reads the pieces of a time at one place of the words after the other.
class TimeReader {
 public:
  explicit TimeReader(const std::vector<std::string>& words) : words_(words) {}

  TimeReading read() {
    TimeReading reading;
    for (std::size_t i = 0; i < words_.size();) {
      if (const std::size_t length = pieceWithRelation(i); length > 0) {
        for (std::size_t k = i; k < i + length; ++k) {
          time_.words += (time_.words.empty() ? "" : " ") + words_[k];
        }
        i += length;
      } else {
        reading.rest.push_back(words_[i++]);
      }
    }
    reading.time = found_ ? std::optional(time_) : std::nullopt;
    return reading;
  }

 private:
  [[nodiscard]] std::string_view at(std::size_t i) const { return i < words_.size() ? std::string_view(words_[i]) : std::string_view(); }
  [[nodiscard]] bool is(std::size_t i, std::initializer_list<std::string_view> list) const {
    return i < words_.size() && std::find(list.begin(), list.end(), at(i)) != list.end();
  }

  /// How many words there say a time; 0: none.
  std::size_t pieceWithRelation(std::size_t i) {
    if (is(i, {"now", "currently"})) {
      return 1;  // the present is meant anyway
    }
    if (is(i, {"right"}) && is(i + 1, {"now"})) {
      return 2;
    }
    if (is(i, {"at"}) && is(i + 1, {"the"}) && is(i + 2, {"moment"})) {
      return 3;
    }
    std::optional<TimeRelation> relation;
    std::size_t start = i;
    if (is(i, {"before", "until", "till", "by"})) {
      relation = TimeRelation::kBefore;
    } else if (is(i, {"since", "after"})) {
      relation = TimeRelation::kSince;
    }
    start += relation || is(i, {"at", "on", "in", "from", "during", "within", "over", "around", "about"}) ? 1 : 0;
    const bool clock_expected = start > i && (relation || is(i, {"at", "around", "about"}));
    const std::size_t length = piece(start, clock_expected);
    if (length == 0) {
      return 0;
    }
    if (relation) {
      time_.relation = *relation;
    }
    found_ = true;
    return start - i + length;
  }

  std::size_t piece(std::size_t i, bool clock_expected) {
    for (const auto read : {&TimeReader::dayPiece, &TimeReader::datePiece, &TimeReader::agoPiece, &TimeReader::stretchPiece}) {
      if (const std::size_t length = (this->*read)(i); length > 0) {
        return length;
      }
    }
    return clockPiece(i, clock_expected);
  }

  /// "today", "last Monday", "this morning", "evening" after a day.
  std::size_t dayPiece(std::size_t i) {
    if (is(i, {"today", "yesterday", "tonight"})) {
      setDaysAgo(at(i) == "yesterday" ? 1 : 0);
      time_.part = at(i) == "tonight" ? std::optional(DayPart::kEvening) : time_.part;
      return 1;
    }
    const bool last = is(i, {"last"});
    const std::size_t name = i + (last || is(i, {"this"}) ? 1 : 0);
    if (const auto weekday = weekdayNamed(at(name))) {
      time_.day = DayPhrase{.days_ago = {}, .weekday = weekday, .before_today = last, .date = {}};
      return name + 1 - i;
    }
    const auto part = partNamed(at(name));
    if (part && name > i) {
      setDaysAgo(last ? 1 : 0);
      time_.part = part;
      return name + 1 - i;
    }
    if (part && time_.day) {
      time_.part = part;
      return 1;
    }
    if (is(i, {"the"}) && partNamed(at(i + 1)) && i > 0 && words_[i - 1] == "in") {
      time_.part = partNamed(at(i + 1));
      return 2;
    }
    return 0;
  }

  /// "3 March", "the 3rd of March 2026", "March 3rd", "2026-03-10".
  std::size_t datePiece(std::size_t i) {
    if (const auto date = isoDate(at(i))) {
      setDate(*date);
      return 1;
    }
    std::size_t next = i + (is(i, {"the"}) ? 1 : 0);
    std::optional<int> month = monthNamed(at(next));
    std::optional<int> day = month ? dayOfMonth(at(next + 1)) : dayOfMonth(at(next));
    next += month ? 2 : 1;
    if (!month) {
      next += is(next, {"of"}) ? 1 : 0;
      month = monthNamed(at(next));
      ++next;
    }
    if (!month || !day) {
      return 0;
    }
    const auto year = wholeNumber(at(next));
    const bool with_year = year && *year >= 1900 && *year <= 2200;
    setDate({with_year ? *year : 0, *month, *day});
    return next + (with_year ? 1 : 0) - i;
  }

  /// "two hours ago", "half an hour ago", "the day before yesterday".
  std::size_t agoPiece(std::size_t i) {
    if (is(i, {"the"}) && is(i + 1, {"day"}) && is(i + 2, {"before"}) && is(i + 3, {"yesterday"})) {
      setDaysAgo(2);
      return 4;
    }
    if (is(i, {"half"}) && is(i + 1, {"an"}) && is(i + 2, {"hour"}) && is(i + 3, {"ago"})) {
      time_.ago_ns = 30 * kMinute_ns;
      return 4;
    }
    const auto count = countNamed(at(i));
    return count && is(i + 2, {"ago"}) && takeUnits(*count, at(i + 1)) ? 3 : 0;
  }

  /// "the last two hours", "the past hour", "this week", "last week", "the last recording".
  std::size_t stretchPiece(std::size_t i) {
    std::size_t next = i + (is(i, {"the"}) ? 1 : 0);
    if (is(next, {"last", "latest"}) && is(next + 1, {"recording", "scan", "drive", "run"})) {
      time_.last_recording = true;
      return next + 2 - i;
    }
    if (is(next, {"this", "last"}) && is(next + 1, {"week"})) {
      time_.weeks_ago = at(next) == "this" ? 0 : 1;
      return next + 2 - i;
    }
    if (!is(next, {"last", "past"})) {
      return 0;
    }
    ++next;
    const auto count = countNamed(at(next));
    next += count ? 1 : 0;
    if (!takeUnits(count.value_or(1), at(next))) {
      return 0;
    }
    time_.relation = TimeRelation::kSince;
    return next + 1 - i;
  }

  bool takeUnits(int count, std::string_view unit) {
    constexpr int kMostDays = 36500;
    if (const auto ns = unitNs(unit)) {
      time_.ago_ns = *ns * count;
      return true;
    }
    if (const auto days = unitDays(unit); days && count * *days <= kMostDays) {
      setDaysAgo(*days * count);
      return true;
    }
    return false;
  }

  /// "8:00", "8 am", "8am", "8 o'clock", "half past 8", "noon"; "8" alone where `expected`.
  std::size_t clockPiece(std::size_t i, bool expected) {
    if (is(i, {"noon", "midday", "midnight"})) {
      time_.minute = at(i) == "midnight" ? 0 : kDayMinutes / 2;
      return 1;
    }
    if (is(i, {"half", "quarter"}) && is(i + 1, {"past", "to"})) {
      const auto hour = hourNamed(at(i + 2));
      if (!hour || (at(i) == "half" && at(i + 1) == "to")) {
        return 0;
      }
      const int quarter = at(i) == "half" ? 30 : 15;
      return setClock(60 * *hour + (at(i + 1) == "past" ? quarter : -quarter), i + 3) - i;
    }
    std::string_view word = at(i);
    std::string_view half;
    if (word.size() > 2 && (word.ends_with("am") || word.ends_with("pm"))) {
      half = word.substr(word.size() - 2);
      word.remove_suffix(2);
    }
    const std::size_t colon = word.find(':');
    const auto hour = hourNamed(word.substr(0, colon));
    const auto minute = colon == std::string_view::npos ? std::optional(0) : wholeNumber(word.substr(colon + 1));
    const bool marked = colon != std::string_view::npos || !half.empty() || is(i + 1, {"am", "pm", "oclock"});
    if (!hour || !minute || *minute > 59 || !(marked || expected)) {
      return 0;
    }
    if (!half.empty()) {
      return setClock(60 * toDayHour(*hour, half) + *minute, i + 1) - i;
    }
    return setClock(60 * *hour + *minute, i + 1) - i;
  }

  static std::optional<int> hourNamed(std::string_view word) {
    const auto hour = word == "a" || word == "an" ? std::nullopt : countNamed(word);
    return hour && *hour <= 24 ? hour : std::nullopt;
  }

  static int toDayHour(int hour, std::string_view half) { return hour > 12 ? hour : hour % 12 + (half == "pm" ? 12 : 0); }

  /// The clock, with "am", "pm" or "o'clock" that may follow at `next`; returns where it ends.
  std::size_t setClock(int minute, std::size_t next) {
    if (is(next, {"oclock"})) {
      ++next;
    }
    if (is(next, {"am", "pm"})) {
      minute = 60 * toDayHour(minute / 60, at(next)) + minute % 60;
      ++next;
    }
    time_.minute = minute;
    return next;
  }

  void setDaysAgo(int days) { time_.day = DayPhrase{.days_ago = days, .weekday = {}, .before_today = false, .date = {}}; }
  void setDate(const CalendarDate& date) { time_.day = DayPhrase{.days_ago = {}, .weekday = {}, .before_today = false, .date = date}; }

  const std::vector<std::string>& words_;
  TimePhrase time_;
  bool found_ = false;
};

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
int clockMinute(const TimePhrase& time) {
  const bool later = time.part && *time.part != DayPart::kMorning;
  return *time.minute + (later && *time.minute < kDayMinutes / 2 && *time.minute > 0 ? kDayMinutes / 2 : 0);
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
    const int minute = clockMinute(time);
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

TimeReading readTime(const std::vector<std::string>& words) {
  return TimeReader(words).read();
}

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
