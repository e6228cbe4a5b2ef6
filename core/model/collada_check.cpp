// SPDX-License-Identifier: Apache-2.0
#include "core/model/collada_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "core/base/error.h"

namespace oikos::model {

namespace {

constexpr std::uint64_t kLargest = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void fail(const std::string& what, const std::string& where) {
  throw base::Error(base::ErrorCode::kInput, what, where);
}

/// The value of an attribute in a tag's text; empty if there is none.
std::string_view attributeOf(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    const std::size_t equals = tag.find_first_not_of(" \t\r\n", at + name.size());
    if (equals == std::string_view::npos || tag[equals] != '=' || std::string_view(" \t\r\n").find(tag[at - 1]) == std::string_view::npos) {
      continue;
    }
    const std::size_t quote = tag.find_first_of("\"'", equals);
    const std::size_t end = quote == std::string_view::npos ? quote : tag.find(tag[quote], quote + 1);
    return end == std::string_view::npos ? std::string_view{} : tag.substr(quote + 1, end - quote - 1);
  }
  return {};
}

std::uint64_t numberOf(std::string_view tag, std::string_view name, std::uint64_t missing, const std::string& where) {
  const std::string_view text = attributeOf(tag, name);
  std::uint64_t number = missing;
  if (!text.empty()) {
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size() || number > kLargest) {
      fail("<" + std::string(tag.substr(0, 60)) + "> has the " + std::string(name) + " '" + std::string(text) + "': must be a number",
           where);
    }
  }
  return number;
}

struct Accessor {
  std::string source;
  std::uint64_t end = 0;  ///< one past the last value that it reaches
};

class AccessorCheck {
 public:
  explicit AccessorCheck(std::string where) : where_(std::move(where)) {}

  void run(std::string_view xml) {
    for (std::size_t begin = xml.find('<'); begin != std::string_view::npos;) {
      const std::size_t end = std::min(xml.find('>', begin), xml.size());
      const std::string_view tag = xml.substr(begin + 1, end - begin - 1);
      const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
      if (name.ends_with("_array")) {
        addArray(tag);
      } else if (name == "accessor") {
        addAccessor(tag, xml.substr(end));
      }
      begin = xml.find('<', end);
    }
    for (const Accessor& accessor : accessors_) {
      const auto size = size_of_array_.find(accessor.source);
      if (size == size_of_array_.end() || accessor.end > size->second) {
        fail("an <accessor> of '" + accessor.source + "' reaches to its value " + std::to_string(accessor.end) + ": there are " +
                 (size == size_of_array_.end() ? "none" : std::to_string(size->second)),
             where_);
      }
    }
  }

 private:
  /// Of arrays that share an id, whichever is meant: the shortest counts.
  void addArray(std::string_view tag) {
    const std::uint64_t size = numberOf(tag, "count", 0, where_);
    const auto [entry, is_new] = size_of_array_.try_emplace("#" + std::string(attributeOf(tag, "id")), size);
    entry->second = std::min(entry->second, size);
  }

  /// A <param> stands for one value from the record's beginning on, also beyond the stride.
  void addAccessor(std::string_view tag, std::string_view rest) {
    const std::string_view inside = rest.substr(0, tag.ends_with('/') ? 0 : rest.find("</accessor"));
    std::uint64_t parameters = 0;
    for (std::size_t at = inside.find("<param"); at != std::string_view::npos; at = inside.find("<param", at + 1)) {
      ++parameters;
    }
    const std::uint64_t count = numberOf(tag, "count", 0, where_);
    const std::uint64_t stride = numberOf(tag, "stride", 1, where_);
    if (count > 0 && stride > kLargest / count) {
      fail("an <accessor> has " + std::to_string(count) + " records of " + std::to_string(stride), where_);
    }
    const std::uint64_t reach = count == 0 ? 0 : (count - 1) * stride + std::max(stride, parameters);
    accessors_.push_back({std::string(attributeOf(tag, "source")), numberOf(tag, "offset", 0, where_) + reach});
  }

  std::string where_;
  std::map<std::string, std::uint64_t> size_of_array_;
  std::vector<Accessor> accessors_;
};

}  // namespace

void checkColladaAccessors(std::string_view xml, const std::string& where) {
  AccessorCheck(where).run(xml);
}

}  // namespace oikos::model
