// SPDX-License-Identifier: Apache-2.0
#include "core/model/shape_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/degrees.h"
#include "core/base/number_text.h"

namespace oikos::model {

namespace {

std::optional<double> findFinite(std::string_view text) {
  const auto number = base::findNumber(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// The whole text as an integer.
template <class Integer>
std::optional<Integer> findInteger(std::string_view text, int base) {
  Integer number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  const bool whole = failure == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(number) : std::nullopt;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (text.empty()) {
      return words;
    }
    words.push_back(text.substr(0, text.find_first_of(" \t\r\n")));
    text.remove_prefix(words.back().size());
  }
}

}  // namespace

std::string NumberField::text() const {
  return base::toText(*value);
}

bool NumberField::set(std::string_view text) const {
  const auto number = findFinite(text);
  *value = number.value_or(*value);
  return number.has_value();
}

std::string NumberField::rule() const {
  return *unit == '\0' ? "must be a number" : "must be a number (" + std::string(unit) + ")";
}

std::string AngleField::text() const {
  return base::toText(base::toDegrees(*value_rad));
}

bool AngleField::set(std::string_view text) const {
  const auto number_deg = findFinite(text);
  *value_rad = number_deg ? *number_deg * base::kRadPerDeg : *value_rad;
  return number_deg.has_value();
}

std::string AngleField::rule() const {
  return "must be a number (degrees)";
}

std::string CountField::text() const {
  return base::toText(std::int64_t{*value});
}

bool CountField::set(std::string_view text) const {
  const auto number = findInteger<int>(text, 10);
  *value = number.value_or(*value);
  return number.has_value();
}

std::string CountField::rule() const {
  return "must be a whole number";
}

std::string ColorField::text() const {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text = "#";
  for (int shift = 20; shift >= 0; shift -= 4) {
    text += kDigits[(*rgb >> shift) & 0xFU];
  }
  return text;
}

bool ColorField::set(std::string_view text) const {
  const auto number = text.size() == 7 && text.front() == '#' ? findInteger<std::uint32_t>(text.substr(1), 16) : std::nullopt;
  *rgb = number.value_or(*rgb);
  return number.has_value();
}

std::string ColorField::rule() const {
  return "must be a colour as #D8CBB2";
}

std::string LengthsField::text() const {
  std::string text;
  for (const double value_m : *values_m) {
    text += (text.empty() ? "" : " ") + base::toText(value_m);
  }
  return text;
}

bool LengthsField::set(std::string_view text) const {
  std::vector<double> read_m;
  for (const std::string_view word : wordsOf(text)) {
    const auto number = findFinite(word);
    if (!number) {
      return false;
    }
    read_m.push_back(*number);
  }
  *values_m = std::move(read_m);
  return true;
}

std::string LengthsField::rule() const {
  return "must be numbers (m) with spaces between them";
}

std::string ChoiceField::text() const {
  return std::string(name_of(value));
}

bool ChoiceField::set(std::string_view text) const {
  return assign(value, text);
}

std::string ChoiceField::rule() const {
  const std::vector<std::string> choices = names();
  std::string all;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    all += (i == 0 ? "" : i + 1 < choices.size() ? ", " : " or ") + choices[i];
  }
  return "must be " + all;
}

std::string ShapeField::text() const {
  return std::visit([](const auto& field) { return field.text(); }, target);
}

bool ShapeField::set(std::string_view text) const {
  return std::visit([&](const auto& field) { return field.set(text); }, target);
}

std::string ShapeField::rule() const {
  return std::visit([](const auto& field) { return field.rule(); }, target);
}

}  // namespace oikos::model
