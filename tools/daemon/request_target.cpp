// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/request_target.h"

#include <charconv>

namespace oikos::daemon {

namespace {

enum class Plus { kPlus, kSpace };

bool decode(std::string_view text, Plus plus, std::string& decoded) {
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i] == '+' && plus == Plus::kSpace ? ' ' : text[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (failed != std::errc() || digits.size() != 2 || end != digits.data() + 2) {
      return false;
    }
    decoded += static_cast<char>(value);
    i += 2;
  }
  return true;
}

/// Takes what stands before the separator off the front of `text`.
std::string_view nextPiece(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return piece;
}

bool parsePath(std::string_view text, RequestTarget& target) {
  text.remove_prefix(1);
  while (!text.empty()) {
    if (!decode(nextPiece(text, '/'), Plus::kPlus, target.path.emplace_back())) {
      return false;
    }
  }
  return true;
}

bool parseQuery(std::string_view text, RequestTarget& target) {
  while (!text.empty()) {
    std::string_view value = nextPiece(text, '&');
    const std::string_view name = nextPiece(value, '=');
    auto& [decoded_name, decoded_value] = target.query.emplace_back();
    if (!decode(name, Plus::kSpace, decoded_name) || !decode(value, Plus::kSpace, decoded_value)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<std::string_view> RequestTarget::find(std::string_view name) const {
  for (const auto& [known, value] : query) {
    if (known == name) {
      return value;
    }
  }
  return std::nullopt;
}

std::optional<RequestTarget> parseRequestTarget(std::string_view target) {
  const std::string_view path = nextPiece(target, '?');
  RequestTarget parsed;
  if (!path.starts_with('/') || !parsePath(path, parsed) || !parseQuery(target, parsed)) {
    return std::nullopt;
  }
  return parsed;
}

}  // namespace oikos::daemon
