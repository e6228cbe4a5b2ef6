// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/number_text.h"

namespace oikos::mapping {

namespace {
constexpr const char* kNarrowSpace = "\u202F";
}

std::string countText(std::int64_t count) {
  std::string digits = base::toText(count);
  const std::size_t first = count < 0 ? 1 : 0;
  for (std::size_t end = digits.size(); end > first + 3; end -= 3) {
    digits.insert(end - 3, kNarrowSpace);
  }
  return digits;
}

std::string numberText(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "–";
  }
  std::string text = base::toFixedText(value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string lengthText(double length_m) {
  if (std::abs(length_m) >= 1.0) {
    return numberText(length_m, 2) + " m";
  }
  return numberText(100.0 * length_m, std::abs(length_m) < 0.0995 ? 1 : 0) + " cm";
}

std::string countedText(std::int64_t count, const std::string& one, const std::string& many) {
  return countText(count) + " " + (count == 1 ? one : many);
}

std::string shareText(std::int64_t part, std::int64_t whole) {
  if (whole <= 0) {
    return "–";
  }
  const double share_percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  if (part > 0 && part < whole) {
    return numberText(std::clamp(share_percent, 0.1, 99.9), 1) + " %";
  }
  return numberText(share_percent, 0) + " %";
}

}  // namespace oikos::mapping
