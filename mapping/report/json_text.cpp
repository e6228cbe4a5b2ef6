// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace oikos::mapping {

namespace {

using Json = nlohmann::ordered_json;

std::string compact(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A list of numbers and words, or a table's row, which may hold points.
bool fitsOneLine(const Json& json) {
  const auto isPlain = [](const Json& item) { return item.is_primitive(); };
  const auto isPlainOrPoint = [&isPlain](const Json& item) {
    return item.is_primitive() || (item.is_array() && item.size() <= 3 && std::all_of(item.begin(), item.end(), isPlain));
  };
  if (json.empty() || json.is_primitive()) {
    return true;
  }
  return json.is_array() && std::any_of(json.begin(), json.end(), isPlain) && std::all_of(json.begin(), json.end(), isPlainOrPoint);
}

void append(const Json& json, int indent, std::string& text) {
  if (fitsOneLine(json)) {
    text += compact(json);
    return;
  }
  const std::string margin(static_cast<std::size_t>(indent) + 1, ' ');
  const char* separator = "\n";
  text += json.is_object() ? '{' : '[';
  for (const auto& [key, value] : json.items()) {
    text += separator + margin + (json.is_object() ? compact(Json(key)) + ": " : "");
    append(value, indent + 1, text);
    separator = ",\n";
  }
  text += "\n" + margin.substr(1) + (json.is_object() ? '}' : ']');
}

}  // namespace

std::string jsonText(const Json& json) {
  std::string text;
  append(json, 0, text);
  return text + "\n";
}

}  // namespace oikos::mapping
