// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace oikos::mapping {

// Numbers as a page for people shows them; the same in every locale.

/// "12 345", with a narrow space that does not break.
[[nodiscard]] std::string countText(std::int64_t count);
/// With `decimals` digits, without a minus before a zero; "–" when not finite.
[[nodiscard]] std::string numberText(double value, int decimals);
/// "0.8 cm", "12 cm", "3.42 m".
[[nodiscard]] std::string lengthText(double length_m);
/// "1 loop", "12 loops".
[[nodiscard]] std::string countedText(std::int64_t count, const std::string& one, const std::string& many);
/// "4 %", "0.3 %", and never "0 %" of something or "100 %" of not all.
[[nodiscard]] std::string shareText(std::int64_t part, std::int64_t whole);

}  // namespace oikos::mapping
