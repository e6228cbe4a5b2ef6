// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace oikos::mapping {

/// CSS of the report's page: light, dark and print. Holds no '<' and no '&', so that the page stays well-formed XML.
[[nodiscard]] std::string_view reportStyleSheet();

}  // namespace oikos::mapping
