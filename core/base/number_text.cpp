// SPDX-License-Identifier: Apache-2.0
#include "core/base/number_text.h"

#include <array>
#include <charconv>
#include <system_error>

#include "core/base/error.h"

namespace oikos::base {

namespace {

// The longest fixed form is that of -DBL_MAX: 310 characters before the point.
constexpr std::size_t kMaxCharacters = 400;

template <class... Arguments>
std::string format(Arguments... arguments) {
  std::array<char, kMaxCharacters> text{};
  const auto [end, failure] = std::to_chars(text.data(), text.data() + text.size(), arguments...);
  OIKOS_CHECK(failure == std::errc());
  return {text.data(), end};
}

}  // namespace

std::string toText(double number) {
  return format(number);
}

std::string toText(std::int64_t number) {
  return format(number);
}

std::string toFixedText(double number, int decimals) {
  return format(number, std::chars_format::fixed, decimals);
}

std::optional<double> findNumber(std::string_view text) {
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = failure == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(number) : std::nullopt;
}

}  // namespace oikos::base
