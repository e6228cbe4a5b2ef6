// SPDX-License-Identifier: Apache-2.0
// What single words of a time say; nothing: the word says no such thing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "semantic/query/time_phrase.h"

namespace oikos::semantic {

constexpr std::int64_t kMinute_ns = 60'000'000'000;
constexpr int kDayMinutes = 24 * 60;

/// 0: Sunday.
[[nodiscard]] std::optional<int> weekdayNamed(std::string_view word);
/// 1: January.
[[nodiscard]] std::optional<int> monthNamed(std::string_view word);
/// Of up to six digits.
[[nodiscard]] std::optional<int> wholeNumber(std::string_view digits);
/// "3", "three", "a".
[[nodiscard]] std::optional<int> countNamed(std::string_view word);
/// "3", "three", up to 24.
[[nodiscard]] std::optional<int> hourNamed(std::string_view word);
/// "3", "3rd".
[[nodiscard]] std::optional<int> dayOfMonth(std::string_view word);
/// "2026-03-10".
[[nodiscard]] std::optional<CalendarDate> isoDate(std::string_view word);
/// "minutes", "hour".
[[nodiscard]] std::optional<std::int64_t> unitNs(std::string_view word);
/// "days", "week".
[[nodiscard]] std::optional<int> unitDays(std::string_view word);
/// "morning".
[[nodiscard]] std::optional<DayPart> partNamed(std::string_view word);

}  // namespace oikos::semantic
