// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace oikos::semantic {

/// Where an element stands in its file, as offsets of bytes.
struct LaidElement {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t begin = 0;      ///< of its start tag
  std::uint32_t tag_end = 0;    ///< past the start tag
  std::uint32_t close = 0;      ///< of its end tag; `tag_end` if the start tag ends it
  std::uint32_t end = 0;        ///< past it all
  std::uint32_t first = kNone;  ///< the first child's number
  std::uint32_t next = kNone;   ///< the next sibling's number
};

/// The elements of a file in the order of their start tags; number 0 is the root. `bytes`: well formed UTF-8 without a document type,
/// below 4 GiB, as the validating reader lets through; anything else is a broken contract.
[[nodiscard]] std::vector<LaidElement> layOut(std::string_view bytes);

/// The name in a start tag.
[[nodiscard]] std::string_view tagName(std::string_view tag);

/// One attribute of a start tag, as ranges within the tag.
struct LaidAttribute {
  std::size_t begin = 0;  ///< of the space before the name
  std::size_t end = 0;    ///< past the closing quote
  std::size_t value_begin = 0;
  std::size_t value_end = 0;
  std::string_view name;
};
[[nodiscard]] std::vector<LaidAttribute> attributesOfTag(std::string_view tag);

/// With the characters escaped that may not stand in a quoted attribute value.
[[nodiscard]] std::string escapedAttribute(std::string_view text);
/// The same between tags.
[[nodiscard]] std::string escapedText(std::string_view text);

}  // namespace oikos::semantic
