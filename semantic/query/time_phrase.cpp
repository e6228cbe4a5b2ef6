// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/time_phrase.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "semantic/query/time_words.h"

namespace oikos::semantic {

namespace {

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

  /// "now", "at the moment": nothing to note, the present is meant anyway.
  [[nodiscard]] std::size_t presentPiece(std::size_t i) const {
    if (is(i, {"now", "currently"})) {
      return 1;
    }
    if ((is(i, {"right", "just"}) && is(i + 1, {"now"})) || (is(i, {"at"}) && is(i + 1, {"present"}))) {
      return 2;
    }
    return is(i, {"at"}) && is(i + 1, {"the"}) && is(i + 2, {"moment", "minute"}) ? 3 : 0;
  }

  /// How many words there say a time; 0: none.
  std::size_t pieceWithRelation(std::size_t i) {
    if (const std::size_t length = presentPiece(i); length > 0) {
      return length;
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

}  // namespace

TimeReading readTime(const std::vector<std::string>& words) {
  return TimeReader(words).read();
}

}  // namespace oikos::semantic
