// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "semantic/xml/home_nodes.h"

namespace oikos::semantic {

/// "<a/>".
[[nodiscard]] bool isEmptyTag(std::string_view tag);

/// The start tag `text`, which says what `before` has, changed so that it says what `after` has: other attributes, their order, quotes and
/// spaces stay.
void appendMergedTag(std::string& out, std::string_view text, const XmlNode& before, const XmlNode& after);

}  // namespace oikos::semantic
