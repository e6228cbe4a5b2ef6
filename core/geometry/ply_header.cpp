// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/ply_header.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/base/error.h"

namespace oikos::geometry {

namespace {

struct ScalarName {
  std::string_view name;
  PlyScalar scalar;
};
constexpr ScalarName kScalarNames[] = {
    {"char", PlyScalar::kInt8},     {"int8", PlyScalar::kInt8},       {"uchar", PlyScalar::kUint8},    {"uint8", PlyScalar::kUint8},
    {"short", PlyScalar::kInt16},   {"int16", PlyScalar::kInt16},     {"ushort", PlyScalar::kUint16},  {"uint16", PlyScalar::kUint16},
    {"int", PlyScalar::kInt32},     {"int32", PlyScalar::kInt32},     {"uint", PlyScalar::kUint32},    {"uint32", PlyScalar::kUint32},
    {"float", PlyScalar::kFloat32}, {"float32", PlyScalar::kFloat32}, {"double", PlyScalar::kFloat64}, {"float64", PlyScalar::kFloat64},
};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == std::string_view::npos ? std::string_view{} : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::vector<std::string> splitWords(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

PlyScalar getScalar(const std::string& name, const PlySource& source) {
  for (const ScalarName& known : kScalarNames) {
    if (known.name == name) {
      return known.scalar;
    }
  }
  source.fail("'" + name + "' is no PLY type (char, uchar, short, ushort, int, uint, float, double)");
}

void addElement(const std::vector<std::string>& words, const PlySource& source, PlyHeader& header) {
  PlyElement element;
  if (words.size() == 3) {
    element.name = words[1];
    const auto [end, failure] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (failure == std::errc{} && end == words[2].data() + words[2].size()) {
      header.elements.push_back(element);
      return;
    }
  }
  source.fail("'element NAME COUNT' expected");
}

void addProperty(const std::vector<std::string>& words, const PlySource& source, PlyHeader& header) {
  if (header.elements.empty()) {
    source.fail("a property before the first element");
  }
  PlyProperty property;
  if (words.size() == 3) {
    property.scalar = getScalar(words[1], source);
  } else if (words.size() == 5 && words[1] == "list") {
    property.list_count = getScalar(words[2], source);
    property.scalar = getScalar(words[3], source);
  } else {
    source.fail("'property TYPE NAME' or 'property list TYPE TYPE NAME' expected");
  }
  property.name = words.back();
  header.elements.back().properties.push_back(property);
}

void setFormat(const std::vector<std::string>& words, const PlySource& source, PlyHeader& header) {
  const std::string format = words.size() > 1 ? words[1] : "";
  if (format != "ascii" && format != "binary_little_endian") {
    source.fail("format '" + format + "' is not supported (ascii, binary_little_endian)");
  }
  header.ascii = format == "ascii";
}

}  // namespace

PlySource::PlySource(const std::filesystem::path& file) : name_(file.string()) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  if (!stream || !(bytes << stream.rdbuf())) {
    throw base::Error(base::ErrorCode::kIo, "cannot be read", name_);
  }
  bytes_ = std::move(bytes).str();
}

void PlySource::fail(const std::string& what) const {
  const std::string where = by_line_ ? std::to_string(line_) : "byte " + std::to_string(position_);
  throw base::Error(base::ErrorCode::kInput, what, name_ + ":" + where);
}

std::string_view PlySource::nextLine() {
  if (position_ >= bytes_.size()) {
    fail("the file ends here, more was announced");
  }
  const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
  const std::string_view line(bytes_.data() + position_, end - position_);
  position_ = std::min(end + 1, bytes_.size());
  ++line_;
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

double PlySource::nextAscii() {
  while (rest_.empty()) {
    rest_ = trimmed(nextLine());
  }
  double value = 0.0;
  const auto [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  if (failure != std::errc{}) {
    fail(std::string(rest_.substr(0, 20)).append(" is not a number"));
  }
  rest_ = trimmed(rest_.substr(static_cast<std::size_t>(end - rest_.data())));
  return value;
}

PlyHeader readPlyHeader(PlySource& source) {
  if (source.nextLine() != "ply") {
    source.fail("not a PLY file: the first line must be 'ply'");
  }
  PlyHeader header;
  bool has_format = false;
  while (true) {
    const std::vector<std::string> words = splitWords(source.nextLine());
    const std::string keyword = words.empty() ? "" : words[0];
    if (keyword == "end_header") {
      break;
    }
    if (keyword == "format") {
      setFormat(words, source, header);
      has_format = true;
    } else if (keyword == "element") {
      addElement(words, source, header);
    } else if (keyword == "property") {
      addProperty(words, source, header);
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      source.fail("'" + keyword + "' is no PLY header keyword");
    }
  }
  if (!has_format) {
    source.fail("the header names no format");
  }
  source.startBody(header.ascii);
  return header;
}

}  // namespace oikos::geometry
