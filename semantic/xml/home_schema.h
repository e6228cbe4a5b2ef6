// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace oikos::semantic {

/// schemas/home.xsd, as it was when the program was built.
[[nodiscard]] std::string_view homeSchema();

}  // namespace oikos::semantic
