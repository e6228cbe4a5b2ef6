// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/node_text.h"

#include "semantic/xml/xml_layout.h"

namespace oikos::semantic {

namespace {

void appendBody(std::string& out, const XmlNode& node, const std::string& indent) {
  if (node.children.empty()) {
    out += node.text.empty() ? "/>" : ">" + escapedText(node.text) + "</" + node.name + ">";
    return;
  }
  out += '>';
  for (const XmlNode& child : node.children) {
    out += "\n  " + indent;
    appendElement(out, child, indent + "  ");
  }
  out += "\n" + indent + "</" + node.name + ">";
}

}  // namespace

void appendElement(std::string& out, const XmlNode& unwritten, const std::string& indent) {
  XmlNode node = unwritten;
  writeOut(node);
  out += "<" + node.name;
  for (const auto& [name, value] : node.attributes) {
    out += " " + name + "=\"" + escapedAttribute(value) + "\"";
  }
  appendBody(out, node, indent);
}

std::string indentAt(std::string_view bytes, std::size_t begin) {
  const std::size_t line = bytes.substr(0, begin).find_last_of('\n');
  const std::size_t start = line == std::string_view::npos ? 0 : line + 1;
  const std::string_view before = bytes.substr(start, begin - start);
  return before.find_first_not_of(" \t") == std::string_view::npos ? std::string(before) : "";
}

std::string reindented(std::string_view text, std::string_view from, std::string_view to) {
  std::string moved;
  for (;;) {
    const std::size_t line_end = text.find('\n');
    moved += text.substr(0, line_end == std::string_view::npos ? text.size() : line_end + 1);
    if (line_end == std::string_view::npos) {
      return moved;
    }
    text.remove_prefix(line_end + 1);
    if (text.starts_with(from)) {
      text.remove_prefix(from.size());
      moved += to;
    }
  }
}

}  // namespace oikos::semantic
