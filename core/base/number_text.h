// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace oikos::base {

/// The shortest decimal text that reads back as the same number; the same in every locale. Not finite: "inf", "-inf", "nan".
[[nodiscard]] std::string toText(double number);
[[nodiscard]] std::string toText(std::int64_t number);

/// With `decimals` digits behind the point, rounded to nearest; the same in every locale.
[[nodiscard]] std::string toFixedText(double number, int decimals);

/// The number that the whole text spells, in any locale; nothing if it is no number or has something before or after it.
[[nodiscard]] std::optional<double> findNumber(std::string_view text);

}  // namespace oikos::base
