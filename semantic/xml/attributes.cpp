// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/attributes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/number_text.h"

namespace oikos::semantic {

namespace {

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::size_t kMaxCorners = 1000;

/// Takes the next number off the front; nothing: there is none, or something else stands there (and stays).
std::optional<double> takeNumber(std::string_view& rest) {
  const auto begin = rest.find_first_not_of(kSpace);
  rest.remove_prefix(begin == std::string_view::npos ? rest.size() : begin);
  const std::string_view word = rest.substr(0, rest.find_first_of(kSpace));
  const auto value = base::findNumber(word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word);
  if (!value || !std::isfinite(*value)) {
    return std::nullopt;
  }
  rest.remove_prefix(word.size());
  return value;
}

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

/// What a list of numbers should have been.
std::string listOf(std::size_t size) {
  switch (size) {
    case 1:
      return "a finite number";
    case 3:
      return "three finite numbers: x y z";
    default:
      return "six finite numbers: x y z in m, roll pitch yaw in degrees";
  }
}

}  // namespace

std::optional<std::string_view> Attributes::find(std::string_view name) const {
  for (const auto& [key, value] : element_.attributes) {
    if (key == name) {
      return value;
    }
  }
  return std::nullopt;
}

void Attributes::refuse(std::string_view name, const std::string& found, const std::string& expected) const {
  findings_.push_back({Severity::kError, element_.line,
                       "element '" + std::string(element_.name) + "', attribute '" + std::string(name) + "'", found, expected});
}

bool Attributes::read(std::string_view name, std::span<double> values) const {
  const auto text = find(name);
  if (!text) {
    return false;
  }
  std::string_view rest = *text;
  std::size_t count = 0;
  while (const auto value = takeNumber(rest)) {
    if (count < values.size()) {
      values[count] = *value;
    }
    ++count;
  }
  if (rest.empty() && count == values.size()) {
    return true;
  }
  const std::string found =
      rest.empty() ? std::to_string(count) + " numbers" : quoted(rest.substr(0, rest.find_first_of(kSpace))) + ", which is no number";
  refuse(name, found, listOf(values.size()));
  return false;
}

std::optional<double> Attributes::number(std::string_view name) const {
  double value = 0.0;
  return read(name, {&value, 1}) ? std::optional(value) : std::nullopt;
}

std::optional<double> Attributes::length(std::string_view name) const {
  const auto value = number(name);
  if (value && *value < 0.0) {
    refuse(name, quoted(text(name)), "at least 0");
  }
  return value;
}

std::optional<double> Attributes::share(std::string_view name) const {
  const auto value = number(name);
  if (value && (*value < 0.0 || *value > 1.0)) {
    refuse(name, quoted(text(name)), "from 0 to 1");
  }
  return value;
}

std::optional<double> Attributes::hours(std::string_view name) const {
  constexpr double kCentury_h = 876'600.0;
  const auto value = number(name);
  if (value && (*value <= 0.0 || *value > kCentury_h)) {
    refuse(name, quoted(text(name)), "above 0 and at most 876600 hours");
    return std::nullopt;
  }
  return value;
}

std::int64_t Attributes::count(std::string_view name) const {
  constexpr double kMost = 9'007'199'254'740'992.0;  // up to which a double counts without a gap
  const double value = number(name).value_or(0.0);
  if (value >= 0.0 && value <= kMost && value == std::floor(value)) {
    return static_cast<std::int64_t>(value);
  }
  refuse(name, quoted(text(name)), "a whole number from 0 to 9007199254740992");
  return 0;
}

std::vector<Eigen::Vector2d> Attributes::polygon(std::string_view name) const {
  std::vector<double> numbers;
  std::string_view rest = find(name).value_or("");
  while (const auto value = takeNumber(rest)) {
    numbers.push_back(*value);
  }
  if (find(name) && (!rest.empty() || numbers.size() % 2 != 0 || numbers.size() < 6 || numbers.size() > 2 * kMaxCorners)) {
    refuse(name, rest.empty() ? std::to_string(numbers.size()) + " numbers" : quoted(rest.substr(0, rest.find_first_of(kSpace))),
           "x and y of each corner, three corners to a thousand");
  }
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    corners.emplace_back(numbers[i], numbers[i + 1]);
  }
  return corners;
}

Pose Attributes::pose(std::string_view name) const {
  std::array<double, 6> n{};
  if (!read(name, n)) {
    return {};
  }
  return {{n[0], n[1], n[2]}, Eigen::Vector3d(n[3], n[4], n[5]) * kRadPerDeg};
}

std::optional<Eigen::Vector3d> Attributes::vector(std::string_view name) const {
  std::array<double, 3> n{};
  return read(name, n) ? std::optional(Eigen::Vector3d(n[0], n[1], n[2])) : std::nullopt;
}

std::optional<Eigen::Vector3d> Attributes::size(std::string_view name) const {
  const auto lengths = vector(name);
  if (lengths && lengths->minCoeff() < 0.0) {
    refuse(name, quoted(text(name)), "no length below 0");
  }
  return lengths;
}

}  // namespace oikos::semantic
