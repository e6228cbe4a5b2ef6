// SPDX-License-Identifier: Apache-2.0
// Elements as text, and how they are indented.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "semantic/xml/home_nodes.h"

namespace oikos::semantic {

/// The whole element, its first line not indented.
void appendElement(std::string& out, const XmlNode& unwritten, const std::string& indent);

/// The space that an element's line begins with; empty if something else stands before it in its line.
[[nodiscard]] std::string indentAt(std::string_view bytes, std::size_t begin);

/// `text` whose lines after the first began with `from` at least, now with `to`.
[[nodiscard]] std::string reindented(std::string_view text, std::string_view from, std::string_view to);

}  // namespace oikos::semantic
