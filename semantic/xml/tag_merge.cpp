// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/tag_merge.h"

#include <map>

#include "semantic/xml/xml_layout.h"

namespace oikos::semantic {

bool isEmptyTag(std::string_view tag) {
  return tag[tag.size() - 2] == '/';
}

void appendMergedTag(std::string& out, std::string_view text, const XmlNode& before, const XmlNode& after) {
  std::map<std::string_view, std::string_view> missing(after.attributes.begin(), after.attributes.end());
  std::map<std::string_view, std::string_view> old(before.attributes.begin(), before.attributes.end());
  const std::map<std::string_view, std::string_view> wanted = missing;
  std::size_t at = 0;
  for (const LaidAttribute& attribute : attributesOfTag(text)) {
    const auto is = old.find(attribute.name);
    const auto becomes = wanted.find(attribute.name);
    missing.erase(attribute.name);
    if (becomes == wanted.end() && is != old.end()) {
      out += text.substr(at, attribute.begin - at);  // without it
      at = attribute.end;
    } else if (becomes != wanted.end() && (is == old.end() || is->second != becomes->second)) {
      out += text.substr(at, attribute.value_begin - at);
      out += escapedAttribute(becomes->second);
      at = attribute.value_end;
    }
  }
  const std::size_t tail = text.find_last_not_of(" \t\r\n", text.size() - (isEmptyTag(text) ? 3 : 2)) + 1;
  out += text.substr(at, tail - at);
  for (const auto& [name, value] : after.attributes) {
    if (const auto is = old.find(name); missing.contains(name) && (is == old.end() || is->second != value)) {
      out += " " + name + "=\"" + escapedAttribute(value) + "\"";
    }
  }
  out += text.substr(tail);
}

}  // namespace oikos::semantic
