// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/access_rules.h"

#include <algorithm>
#include <optional>

#include "tools/daemon/listen_address.h"
#include "tools/daemon/token_file.h"

namespace oikos::daemon {

namespace {

/// Of ASCII letters only, whatever the locale.
char lowerCase(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equalNames(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lowerCase(x) == lowerCase(y); });
}

bool isPort(std::string_view text) {
  return text.size() <= 5 && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Without port and brackets; nothing if it is no host.
std::optional<std::string_view> hostOf(std::string_view header) {
  const bool bracket = header.starts_with('[');
  const std::size_t end = bracket ? header.find(']') : header.find(':');
  const std::string_view host = bracket ? header.substr(1, end == std::string_view::npos ? end : end - 1) : header.substr(0, end);
  const std::string_view rest = end == std::string_view::npos ? std::string_view() : header.substr(end + (bracket ? 1 : 0));
  const bool whole = (rest.empty() && !(bracket && end == std::string_view::npos)) || (rest.starts_with(':') && isPort(rest.substr(1)));
  return whole && !host.empty() ? std::optional(host) : std::nullopt;
}

}  // namespace

bool AccessRules::allowsHost(std::string_view header) const {
  const std::optional<std::string_view> host = hostOf(header);
  if (!host) {
    return false;
  }
  const std::string name(*host);
  return equalNames(name, "localhost") || equalNames(name, listen_host) || isLoopback(name) ||
         (!isLoopback(listen_host) && isAddress(name));
}

bool AccessRules::allows(Access access, std::string_view authorization) const {
  constexpr std::string_view kScheme = "Bearer ";
  if (access == Access::kOpen || (access == Access::kRead && !read_needs_token)) {
    return true;
  }
  return !token.empty() && equalNames(authorization.substr(0, kScheme.size()), kScheme) &&
         equalInConstantTime(authorization.substr(kScheme.size()), token);
}

}  // namespace oikos::daemon
