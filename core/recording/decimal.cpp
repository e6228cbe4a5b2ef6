// SPDX-License-Identifier: Apache-2.0
#include "core/recording/decimal.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace oikos::recording {

namespace {

constexpr int kStampDecimals = 9;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view withoutPlus(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  return text;
}

/// A decimal number taken apart: digits (without sign and point) times ten to the exponent.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

std::optional<int> parseExponent(std::string_view text) {
  text = withoutPlus(text);
  int exponent = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  const bool whole = failure == std::errc() && end == text.data() + text.size();
  return whole && std::abs(exponent) <= 100 ? std::optional<int>(exponent) : std::nullopt;
}

std::optional<Decimal> parseDecimal(std::string_view text) {
  Decimal decimal;
  text = withoutPlus(text);
  if (!text.empty() && text.front() == '-') {
    decimal.negative = true;
    text.remove_prefix(1);
  }
  bool after_point = false;
  while (!text.empty() && (isDigit(text.front()) || (text.front() == '.' && !after_point))) {
    if (text.front() == '.') {
      after_point = true;
    } else {
      decimal.digits += text.front();
      decimal.exponent -= after_point ? 1 : 0;
    }
    text.remove_prefix(1);
  }
  if (decimal.digits.empty()) {
    return std::nullopt;
  }
  if (!text.empty()) {
    const auto exponent = text.front() == 'e' || text.front() == 'E' ? parseExponent(text.substr(1)) : std::nullopt;
    if (!exponent) {
      return std::nullopt;
    }
    decimal.exponent += *exponent;
  }
  return decimal;
}

}  // namespace

std::vector<std::string_view> splitFields(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> fields;
  std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos || line[begin] == '#') {
    return fields;
  }
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

std::optional<double> parseNumber(std::string_view text) {
  text = withoutPlus(text);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = failure == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<std::int64_t> parseStampNs(std::string_view text) {
  auto decimal = parseDecimal(text);
  if (!decimal) {
    return std::nullopt;
  }
  const int shift = decimal->exponent + kStampDecimals;  // digits * 10^shift nanoseconds
  bool round_up = false;
  if (shift >= 0) {
    decimal->digits += std::string(static_cast<std::size_t>(shift), '0');
  } else {
    const auto dropped = static_cast<std::size_t>(-shift);
    const std::size_t size = decimal->digits.size();
    round_up = dropped <= size && decimal->digits[size - dropped] >= '5';
    decimal->digits.erase(dropped < size ? size - dropped : 0);
  }
  std::int64_t stamp_ns = 0;
  const std::string& digits = decimal->digits;
  if (!digits.empty() && std::from_chars(digits.data(), digits.data() + digits.size(), stamp_ns).ec != std::errc()) {
    return std::nullopt;
  }
  if (stamp_ns == std::numeric_limits<std::int64_t>::max()) {
    return std::nullopt;
  }
  stamp_ns += round_up ? 1 : 0;
  return decimal->negative ? -stamp_ns : stamp_ns;
}

std::string formatStamp(std::int64_t stamp_ns) {
  constexpr std::uint64_t kSecond_ns = 1'000'000'000;
  const std::uint64_t magnitude_ns = stamp_ns < 0 ? 0 - static_cast<std::uint64_t>(stamp_ns) : static_cast<std::uint64_t>(stamp_ns);
  std::string fraction = std::to_string(magnitude_ns % kSecond_ns);
  fraction.insert(0, static_cast<std::size_t>(kStampDecimals) - fraction.size(), '0');
  if (magnitude_ns % 1000 == 0) {
    fraction.resize(6);
  }
  std::string text(stamp_ns < 0 ? 1 : 0, '-');
  text.append(std::to_string(magnitude_ns / kSecond_ns)).append(1, '.').append(fraction);
  return text;
}

std::string formatValue(double value) {
  constexpr int kDecimals = 9;
  std::array<char, 400> buffer{};
  const double shown = std::abs(value) < 0.5e-9 ? 0.0 : value;
  const auto [end, failure] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), shown, std::chars_format::fixed, kDecimals);
  return failure == std::errc() ? std::string(buffer.data(), end) : std::string("nan");
}

}  // namespace oikos::recording
