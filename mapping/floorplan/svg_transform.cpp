// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <cmath>

#include "core/base/degrees.h"
#include "core/base/number_text.h"
#include "mapping/floorplan/plan_readers.h"

namespace oikos::mapping {

namespace {

bool isBetween(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

Eigen::Affine2d affine(double a, double b, double c, double d) {
  Eigen::Affine2d T = Eigen::Affine2d::Identity();
  T.linear() << a, c, b, d;
  return T;
}

Eigen::Affine2d translation(double x, double y) {
  return Eigen::Affine2d(Eigen::Translation2d(x, y));
}

Eigen::Affine2d turn(double angle_deg) {
  return Eigen::Affine2d(Eigen::Rotation2Dd(angle_deg * base::kRadPerDeg));
}

Eigen::Affine2d makeTransform(std::string_view name, const std::vector<double>& n, const PlanSource& source) {
  const std::size_t count = n.size();
  if (name == "matrix" && count == 6) {
    return translation(n[4], n[5]) * affine(n[0], n[1], n[2], n[3]);
  }
  if (name == "translate" && (count == 1 || count == 2)) {
    return translation(n[0], count == 2 ? n[1] : 0.0);
  }
  if (name == "scale" && (count == 1 || count == 2)) {
    return affine(n[0], 0.0, 0.0, count == 2 ? n[1] : n[0]);
  }
  if (name == "rotate" && count == 1) {
    return turn(n[0]);
  }
  if (name == "rotate" && count == 3) {
    return translation(n[1], n[2]) * turn(n[0]) * translation(-n[1], -n[2]);
  }
  if (name == "skewX" && count == 1) {
    return affine(1.0, 0.0, std::tan(n[0] * base::kRadPerDeg), 1.0);
  }
  if (name == "skewY" && count == 1) {
    return affine(1.0, std::tan(n[0] * base::kRadPerDeg), 0.0, 1.0);
  }
  refusePlan(source, "transform: \"" + std::string(name) + "\" with " + base::toText(static_cast<std::int64_t>(count)) +
                         " numbers; must be matrix (6), translate (1 or 2), scale (1 or 2), rotate (1 or 3), skewX (1) or skewY (1)");
}

}  // namespace

std::vector<double> parseSvgNumbers(std::string_view text, const PlanSource& source) {
  std::vector<double> numbers;
  while (true) {
    while (!text.empty() && isBetween(text.front())) {
      text.remove_prefix(1);
    }
    if (text.empty()) {
      return numbers;
    }
    std::size_t end = 0;
    while (end < text.size() && !isBetween(text[end])) {
      // "1-2" and "1e-2": a sign begins a number unless it belongs to an exponent.
      const bool sign = text[end] == '-' || text[end] == '+';
      if (end > 0 && sign && text[end - 1] != 'e' && text[end - 1] != 'E') {
        break;
      }
      ++end;
    }
    const std::string_view word = text.substr(0, end);
    const auto number = base::findNumber(word.front() == '+' ? word.substr(1) : word);
    if (!number || !std::isfinite(*number)) {
      refusePlan(source, "\"" + std::string(word) + "\": must be a number");
    }
    numbers.push_back(*number);
    text.remove_prefix(end);
  }
}

Eigen::Affine2d parseSvgTransform(std::string_view text, const PlanSource& source) {
  Eigen::Affine2d T = Eigen::Affine2d::Identity();
  while (true) {
    while (!text.empty() && isBetween(text.front())) {
      text.remove_prefix(1);
    }
    if (text.empty()) {
      return T;
    }
    const std::size_t open = text.find('(');
    const std::size_t close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
      refusePlan(source, "transform: \"" + std::string(text) + "\": must be NAME(NUMBERS)");
    }
    std::string_view name = text.substr(0, open);
    while (!name.empty() && isBetween(name.back())) {
      name.remove_suffix(1);
    }
    T = T * makeTransform(name, parseSvgNumbers(text.substr(open + 1, close - open - 1), source), source);
    text.remove_prefix(close + 1);
  }
}

}  // namespace oikos::mapping
