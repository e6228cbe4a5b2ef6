// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oikos::recording {

/// The fields of a line, which blanks, tabs (and a carriage return at the end) separate; none of a comment ('#') or an empty line.
[[nodiscard]] std::vector<std::string_view> splitFields(std::string_view line);

/// A whole decimal number, whatever the locale; nothing if anything else is in the text or the number is not finite.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

/// Decimal seconds to nanoseconds without a detour through floating point, so that no digit of a Unix stamp is lost; digits beyond
/// the ninth are rounded. Exponents are understood. Nothing for anything else, or out of the range of 64 bits.
[[nodiscard]] std::optional<std::int64_t> parseStampNs(std::string_view text);

/// Decimal seconds with six digits after the point, or nine if there are parts of a microsecond.
[[nodiscard]] std::string formatStamp(std::int64_t stamp_ns);

/// Nine digits after the point, locale-free, never "-0".
[[nodiscard]] std::string formatValue(double value);

}  // namespace oikos::recording
