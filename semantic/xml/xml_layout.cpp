// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/xml_layout.h"

#include <limits>
#include <string>

#include "core/base/error.h"

namespace oikos::semantic {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// Past the first `mark` at or behind `from`.
std::size_t past(std::string_view bytes, std::string_view mark, std::size_t from) {
  const std::size_t found = bytes.find(mark, from);
  OIKOS_CHECK(found != std::string_view::npos);
  return found + mark.size();
}

/// Past the '>' that ends the tag at `begin`; one in quotes does not.
std::size_t pastTag(std::string_view bytes, std::size_t begin) {
  for (std::size_t i = begin; i < bytes.size(); ++i) {
    if (bytes[i] == '"' || bytes[i] == '\'') {
      i = past(bytes, bytes.substr(i, 1), i + 1) - 1;
    } else if (bytes[i] == '>') {
      return i + 1;
    }
  }
  OIKOS_CHECK(false);
  return bytes.size();
}

class Layout {
 public:
  explicit Layout(std::string_view bytes) : bytes_(bytes) { OIKOS_CHECK(bytes.size() < std::numeric_limits<std::uint32_t>::max()); }

  std::vector<LaidElement> run() {
    for (std::size_t at = bytes_.find('<'); at != std::string_view::npos; at = bytes_.find('<', at)) {
      at = readMarkup(at);
    }
    OIKOS_CHECK(open_.empty() && !elements_.empty());
    return std::move(elements_);
  }

 private:
  /// Past what begins at `at`.
  std::size_t readMarkup(std::size_t at) {
    const std::string_view rest = bytes_.substr(at);
    if (rest.starts_with("<!--")) {
      return past(bytes_, "-->", at + 4);
    }
    if (rest.starts_with("<![CDATA[")) {
      return past(bytes_, "]]>", at);
    }
    if (rest.starts_with("<?")) {
      return past(bytes_, "?>", at);
    }
    const std::size_t end = pastTag(bytes_, at);
    if (rest.starts_with("</")) {
      close(at, end);
    } else {
      open(at, end);
    }
    return end;
  }

  void open(std::size_t begin, std::size_t end) {
    const auto number = static_cast<std::uint32_t>(elements_.size());
    LaidElement element;
    element.begin = static_cast<std::uint32_t>(begin);
    element.tag_end = element.close = element.end = static_cast<std::uint32_t>(end);
    elements_.push_back(element);
    if (!open_.empty()) {
      std::uint32_t& slot = last_child_.back() == LaidElement::kNone ? elements_[open_.back()].first : elements_[last_child_.back()].next;
      slot = number;
      last_child_.back() = number;
    }
    if (bytes_[end - 2] != '/') {
      open_.push_back(number);
      last_child_.push_back(LaidElement::kNone);
    }
  }

  void close(std::size_t begin, std::size_t end) {
    OIKOS_CHECK(!open_.empty());
    elements_[open_.back()].close = static_cast<std::uint32_t>(begin);
    elements_[open_.back()].end = static_cast<std::uint32_t>(end);
    open_.pop_back();
    last_child_.pop_back();
  }

  std::string_view bytes_;
  std::vector<LaidElement> elements_;
  std::vector<std::uint32_t> open_;
  std::vector<std::uint32_t> last_child_;  // of each open one
};

std::string escaped(std::string_view text, bool in_attribute) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += in_attribute ? "&quot;" : "\"";
        break;
      case '\'':
        safe += in_attribute ? "&apos;" : "'";
        break;
      case '\t':
      case '\n':
      case '\r':
        safe += "&#" + std::to_string(static_cast<int>(c)) + ";";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

}  // namespace

std::vector<LaidElement> layOut(std::string_view bytes) {
  return Layout(bytes).run();
}

std::string_view tagName(std::string_view tag) {
  const std::string_view rest = tag.substr(1);
  return rest.substr(0, rest.find_first_of(" \t\r\n/>"));
}

std::vector<LaidAttribute> attributesOfTag(std::string_view tag) {
  std::vector<LaidAttribute> attributes;
  std::size_t at = 1 + tagName(tag).size();
  for (;;) {
    LaidAttribute attribute;
    attribute.begin = at;
    const std::size_t name = tag.find_first_not_of(kSpace, at);
    OIKOS_CHECK(name != std::string_view::npos);
    if (tag[name] == '/' || tag[name] == '>') {
      return attributes;
    }
    const std::size_t name_end = tag.find_first_of(" \t\r\n=", name);
    const std::size_t quote = tag.find_first_of("\"'", name_end);
    OIKOS_CHECK(quote != std::string_view::npos);
    attribute.name = tag.substr(name, name_end - name);
    attribute.value_begin = quote + 1;
    attribute.end = past(tag, tag.substr(quote, 1), quote + 1);
    attribute.value_end = attribute.end - 1;
    at = attribute.end;
    attributes.push_back(attribute);
  }
}

std::string escapedAttribute(std::string_view text) {
  return escaped(text, true);
}

std::string escapedText(std::string_view text) {
  return escaped(text, false);
}

}  // namespace oikos::semantic
