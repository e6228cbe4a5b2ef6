// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/time_words.h"

#include <algorithm>
#include <array>

namespace oikos::semantic {

namespace {

template <std::size_t N>
std::optional<int> findIn(const std::array<std::string_view, N>& names, std::string_view word) {
  const auto found = std::find(names.begin(), names.end(), word);
  return found == names.end() ? std::nullopt : std::optional(static_cast<int>(found - names.begin()));
}

}  // namespace

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

std::optional<int> countNamed(std::string_view word) {
  static constexpr std::array<std::string_view, 13> names{"zero",  "one",   "two",  "three", "four",   "five",  "six",
                                                          "seven", "eight", "nine", "ten",   "eleven", "twelve"};
  if (word == "a" || word == "an") {
    return 1;
  }
  const auto named = findIn(names, word);
  return named ? named : wholeNumber(word);
}

std::optional<int> hourNamed(std::string_view word) {
  const auto hour = word == "a" || word == "an" ? std::nullopt : countNamed(word);
  return hour && *hour <= 24 ? hour : std::nullopt;
}

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

}  // namespace oikos::semantic
