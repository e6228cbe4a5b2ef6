// SPDX-License-Identifier: Apache-2.0
#include "core/base/rfc3339.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>

namespace oikos::base {

namespace {

/// Consumes a text from its front; once something does not fit, it stays failed.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  int digits(std::size_t count) {
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value = value * 10 + digit();
    }
    return value;
  }
  char oneOf(std::string_view allowed) {
    if (rest_.empty() || allowed.find(rest_.front()) == std::string_view::npos) {
      failed_ = true;
      return '\0';
    }
    const char found = rest_.front();
    rest_.remove_prefix(1);
    return found;
  }
  [[nodiscard]] bool sees(char c) const { return !rest_.empty() && rest_.front() == c; }
  [[nodiscard]] bool seesDigit() const { return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; }
  int digit() { return oneOf("0123456789") - '0'; }
  [[nodiscard]] bool finished() const { return !failed_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool failed_ = false;
};

std::int64_t fractionNs(Scanner& scanner) {
  if (!scanner.sees('.')) {
    return 0;
  }
  scanner.oneOf(".");
  std::int64_t fraction_ns = scanner.digit() * std::int64_t{100'000'000};
  for (std::int64_t unit_ns = 10'000'000; scanner.seesDigit(); unit_ns /= 10) {
    fraction_ns += scanner.digit() * unit_ns;
  }
  return fraction_ns;
}

struct Offset {
  int minutes = 0;
  bool valid = false;
};

Offset offset(Scanner& scanner) {
  const char sign = scanner.oneOf("Zz+-");
  if (sign != '+' && sign != '-') {
    return {0, true};
  }
  const int hours = scanner.digits(2);
  scanner.oneOf(":");
  const int minutes = scanner.digits(2);
  return {(sign == '-' ? -1 : 1) * (hours * 60 + minutes), hours <= 23 && minutes <= 59};
}

}  // namespace

std::optional<std::int64_t> parseRfc3339Ns(std::string_view text) {
  Scanner scanner(text);
  const int year = scanner.digits(4);
  scanner.oneOf("-");
  const int month = scanner.digits(2);
  scanner.oneOf("-");
  const int day = scanner.digits(2);
  scanner.oneOf("Tt ");
  const int hour = scanner.digits(2);
  scanner.oneOf(":");
  const int minute = scanner.digits(2);
  scanner.oneOf(":");
  const int second = scanner.digits(2);
  const std::int64_t fraction_ns = fractionNs(scanner);
  const Offset zone = offset(scanner);
  if (!scanner.finished() || !zone.valid || hour > 23 || minute > 59 || second > 60 || year < 1700 || year > 2200) {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) {
    return std::nullopt;
  }
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  const std::int64_t minutes = days * 1'440 + std::int64_t{60} * hour + minute - zone.minutes;
  const std::int64_t seconds = minutes * 60 + second;
  return seconds * 1'000'000'000 + fraction_ns;
}

std::string toRfc3339(std::int64_t time_ns) {
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(time_ns)};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), static_cast<int>(clock.hours().count()),
                static_cast<int>(clock.minutes().count()), static_cast<int>(clock.seconds().count()));
  std::string result = text.data();
  if (clock.subseconds().count() != 0) {
    std::snprintf(text.data(), text.size(), ".%09lld", static_cast<long long>(clock.subseconds().count()));
    result += text.data();
    result.erase(result.find_last_not_of('0') + 1);
  }
  return result + "Z";
}

}  // namespace oikos::base
