// SPDX-License-Identifier: Apache-2.0
#include "core/model/nesting_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/error.h"

namespace oikos::model {

namespace {

constexpr int kMaxDepth = 256;

void checkDepth(int depth, const std::string& where) {
  if (depth > kMaxDepth) {
    throw base::Error(base::ErrorCode::kInput, "is nested too deep: must be at most " + std::to_string(kMaxDepth) + " levels", where);
  }
}

/// Where a tag that begins at `begin` ends; a '>' in quotes does not end it.
std::size_t endOfTag(std::string_view xml, std::size_t begin) {
  char quote = '\0';
  for (std::size_t i = begin; i < xml.size(); ++i) {
    if (quote != '\0') {
      quote = xml[i] == quote ? '\0' : quote;
    } else if (xml[i] == '"' || xml[i] == '\'') {
      quote = xml[i];
    } else if (xml[i] == '>') {
      return i;
    }
  }
  return xml.size();
}

void checkJsonNesting(std::string_view json, const std::string& where) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      checkDepth(++depth, where);
    } else if (!in_string && (c == ']' || c == '}')) {
      --depth;
    }
  }
}

std::vector<std::vector<std::size_t>> childrenOf(const nlohmann::json& gltf) {
  std::vector<std::vector<std::size_t>> children;
  for (const nlohmann::json& node : gltf.value("nodes", nlohmann::json::array())) {
    std::vector<std::size_t>& mine = children.emplace_back();
    for (const nlohmann::json& child : node.value("children", nlohmann::json::array())) {
      mine.push_back(child.get<std::size_t>());
    }
  }
  return children;
}

/// Goes down from all nodes at once: what is left after n steps has n ancestors, and a circle never ends.
void checkNodes(const std::vector<std::vector<std::size_t>>& children, const std::string& where) {
  std::vector<char> here(children.size(), 1);
  bool is_any = !children.empty();
  for (int depth = 1; is_any; ++depth) {
    checkDepth(depth, where);
    is_any = false;
    std::vector<char> below(children.size(), 0);
    for (std::size_t i = 0; i < children.size(); ++i) {
      for (const std::size_t child : here[i] != 0 ? children[i] : std::vector<std::size_t>{}) {
        if (child < below.size()) {
          below[child] = 1;
          is_any = true;
        }
      }
    }
    here.swap(below);
  }
}

/// The JSON chunk of a GLB (glTF 2.0 specification, chapter 4.4), or the whole text.
std::string_view jsonOf(std::string_view bytes) {
  constexpr std::size_t kChunk = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < kChunk) {
    return bytes;
  }
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  return bytes.substr(kChunk, length);
}

}  // namespace

void checkXmlNesting(std::string_view xml, const std::string& where) {
  int depth = 0;
  for (std::size_t begin = xml.find('<'); begin != std::string_view::npos;) {
    const std::string_view rest = xml.substr(begin);
    std::size_t end = 0;
    if (rest.starts_with("<!--")) {
      end = xml.find("-->", begin + 4);
    } else if (rest.starts_with("<![CDATA[")) {
      end = xml.find("]]>", begin);
    } else {
      end = endOfTag(xml, begin);
      const bool is_closed = end > begin && xml[end - 1] == '/';
      depth += rest.starts_with("</") ? -1 : rest.starts_with("<?") || rest.starts_with("<!") || is_closed ? 0 : 1;
      checkDepth(depth, where);
    }
    begin = end == std::string_view::npos ? end : xml.find('<', end);
  }
}

void checkGltfNesting(std::string_view bytes, const std::string& where) {
  const std::string_view json = jsonOf(bytes);
  checkJsonNesting(json, where);
  try {
    checkNodes(childrenOf(nlohmann::json::parse(json)), where);
  } catch (const nlohmann::json::exception& error) {
    throw base::Error(base::ErrorCode::kInput, "is not valid glTF: " + std::string(error.what()), where);
  }
}

}  // namespace oikos::model
