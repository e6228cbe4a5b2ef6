// SPDX-License-Identifier: Apache-2.0
#include "core/base/degrees.h"

#include <array>
#include <charconv>
#include <string_view>

#include "core/base/number_text.h"

namespace oikos::base {

double toDegrees(double rad) {
  const double degrees = rad / kRadPerDeg;
  std::array<char, 64> text{};
  for (int digits = 6; digits <= 17; ++digits) {
    const auto [end, failure] = std::to_chars(text.data(), text.data() + text.size(), degrees, std::chars_format::general, digits);
    const auto value = findNumber({text.data(), static_cast<std::size_t>(end - text.data())});
    if (value && *value * kRadPerDeg == rad) {
      return *value + 0.0;  // no -0
    }
  }
  return degrees;
}

}  // namespace oikos::base
