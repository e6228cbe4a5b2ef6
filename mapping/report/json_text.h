// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace oikos::mapping {

/// JSON for people and for `diff`: an object's members and a list's objects and lists on lines of their own, everything that
/// has neither in it on one line. Bytes that are not UTF-8 become U+FFFD. Ends with a newline.
[[nodiscard]] std::string jsonText(const nlohmann::ordered_json& json);

}  // namespace oikos::mapping
