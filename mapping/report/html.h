// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace oikos::mapping {

/// Text from outside (file names, messages) made safe inside an element or a quoted attribute. Bytes that are not UTF-8 and control
/// characters, which no HTML document may hold, become U+FFFD.
[[nodiscard]] std::string escapeHtml(std::string_view text);

/// For data URIs (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace oikos::mapping
