// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "semantic/model/finding.h"

namespace oikos::semantic {

/// An element's start, while it is read.
struct XmlElement {
  std::string_view name;
  int line = 0;
  int depth = 0;                                                                 ///< 0: the root
  const std::vector<std::pair<std::string_view, std::string_view>>& attributes;  ///< name and value, until the handler returns
};

struct ElementHandler {
  std::function<void(const XmlElement&)> element;                               ///< at each start
  std::function<void(std::string_view name, const std::string& content)> text;  ///< at each end: the text before it, after the last start
};

struct XmlReading {
  bool complete = false;          ///< the end was reached: everything is well formed
  std::vector<Finding> findings;  ///< what the schema does not allow, in the order of the file
};

/// Streams through XML in a few megabytes of memory, whatever its size, and hands on every element in order, those that the schema
/// refuses too. It stops at the first that is not well formed, below 32 levels, after 1000 findings, and at a document type: no entity is
/// ever expanded and nothing else is ever opened. Throws Error{kIo} if `input` (which `where` names) cannot be read to its end,
/// Error{kInput} if it is larger than 1 GiB.
[[nodiscard]] XmlReading readValidated(std::istream& input, const std::string& where, std::string_view schema,
                                       const ElementHandler& handler);

}  // namespace oikos::semantic
