// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oikos::daemon {

/// A request's path and query, decoded.
struct RequestTarget {
  std::vector<std::string> path;  ///< its segments: {"v1", "objects", "cup 1"}
  std::vector<std::pair<std::string, std::string>> query;

  /// The first value of a parameter; nothing if it is not there.
  [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const;
};

/// Nothing if it does not start with a slash or holds a percent sign without two hexadecimal digits. Segments are split before they are
/// decoded, so an encoded slash stays within its segment; in the query '+' is a space.
[[nodiscard]] std::optional<RequestTarget> parseRequestTarget(std::string_view target);

}  // namespace oikos::daemon
