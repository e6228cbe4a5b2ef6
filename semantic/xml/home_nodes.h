// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::semantic {

/// An element as Oikos would write it: attributes and children in the schema's order, nothing written that is a default.
struct XmlNode {
  std::string name;
  std::string id;  ///< what tells it from its siblings of the same name; empty: its position
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlNode> children;
  std::string text;
  /// What it is made of, as long as it is not written out: of most elements it only matters whether they changed. Must outlive the node.
  std::variant<std::monostate, const Room*, const LargeObject*, const SmallObject*> source;
  bool whole = false;  ///< to be replaced as one where anything in it changed
};

/// What of an element's optional children stands in the file, though it says nothing.
struct WrittenAnyway {
  bool dock = false;
  bool vocabulary = false;
};

/// The root; rooms are not written out.
[[nodiscard]] XmlNode nodeOf(const Home& home, const WrittenAnyway& anyway);

/// Fills in attributes and children from the source. Furniture and small objects among the children are not written out themselves.
void writeOut(XmlNode& node);

/// Whether both would be written in the same way.
[[nodiscard]] bool isSame(const XmlNode& a, const XmlNode& b);

}  // namespace oikos::semantic
