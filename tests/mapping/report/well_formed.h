// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace oikos::mapping::test {

/// What makes the text no well-formed XML (tags, attributes, references; the document type is passed over), with the place;
/// empty when it is well-formed.
[[nodiscard]] std::string xmlProblem(const std::string& text);

}  // namespace oikos::mapping::test
