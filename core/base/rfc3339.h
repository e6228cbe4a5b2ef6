// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace oikos::base {

/// Nanoseconds since 1970-01-01T00:00:00Z of a time such as `2024-05-17T09:30:00.25+02:00` (RFC 3339, years 1700 to 2200; a space may stand
/// for the T). Nothing if it is anything else, a date that does not exist and a time without offset included.
[[nodiscard]] std::optional<std::int64_t> parseRfc3339Ns(std::string_view text);

/// For instance `2024-05-17T07:30:00.25Z`: UTC, with as many digits of the second as it takes.
[[nodiscard]] std::string toRfc3339(std::int64_t time_ns);

}  // namespace oikos::base
