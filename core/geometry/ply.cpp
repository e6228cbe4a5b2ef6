// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/ply.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace oikos::geometry {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is read and written as it lies in memory");

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct ScalarName {
  std::string_view name;
  Scalar scalar;
};
constexpr ScalarName kScalarNames[] = {
    {"char", Scalar::kInt8},     {"int8", Scalar::kInt8},       {"uchar", Scalar::kUint8},    {"uint8", Scalar::kUint8},
    {"short", Scalar::kInt16},   {"int16", Scalar::kInt16},     {"ushort", Scalar::kUint16},  {"uint16", Scalar::kUint16},
    {"int", Scalar::kInt32},     {"int32", Scalar::kInt32},     {"uint", Scalar::kUint32},    {"uint32", Scalar::kUint32},
    {"float", Scalar::kFloat32}, {"float32", Scalar::kFloat32}, {"double", Scalar::kFloat64}, {"float64", Scalar::kFloat64},
};

struct Property {
  std::string name;
  Scalar scalar = Scalar::kFloat32;
  std::optional<Scalar> list_count;  ///< set: a list whose length is of this type
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = false;
  std::vector<Element> elements;
};

/// The file's bytes, a read position and the words for errors at it.
class Source {
 public:
  explicit Source(const std::filesystem::path& file) : name_(file.string()) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    if (!stream || !(bytes << stream.rdbuf())) {
      throw base::Error(base::ErrorCode::kIo, "cannot be read", name_);
    }
    bytes_ = std::move(bytes).str();
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string where = by_line_ ? std::to_string(line_) : "byte " + std::to_string(position_);
    throw base::Error(base::ErrorCode::kInput, what, name_ + ":" + where);
  }

  std::string_view nextLine() {
    if (position_ >= bytes_.size()) {
      fail("the file ends here, more was announced");
    }
    const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
    std::string_view line(bytes_.data() + position_, end - position_);
    position_ = std::min(end + 1, bytes_.size());
    ++line_;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }

  void startBody(bool ascii) { by_line_ = ascii; }

  double nextBinary(Scalar scalar) {
    switch (scalar) {
      case Scalar::kInt8:
        return take<std::int8_t>();
      case Scalar::kUint8:
        return take<std::uint8_t>();
      case Scalar::kInt16:
        return take<std::int16_t>();
      case Scalar::kUint16:
        return take<std::uint16_t>();
      case Scalar::kInt32:
        return take<std::int32_t>();
      case Scalar::kUint32:
        return take<std::uint32_t>();
      case Scalar::kFloat32:
        return static_cast<double>(take<float>());
      case Scalar::kFloat64:
        break;
    }
    return take<double>();
  }

  /// Values stand one record a line; a line is opened by the first value asked of it.
  double nextAscii() {
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

  [[nodiscard]] std::size_t bytesLeft() const { return bytes_.size() - position_; }

 private:
  static std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    return begin == std::string_view::npos ? std::string_view{} : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
  }

  template <typename T>
  T take() {
    if (bytesLeft() < sizeof(T)) {
      fail("the file ends here, more was announced");
    }
    T value;
    std::memcpy(&value, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  std::string name_;
  std::string bytes_;
  std::size_t position_ = 0;
  int line_ = 0;
  bool by_line_ = true;
  std::string_view rest_;
};

std::vector<std::string> splitWords(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

Scalar getScalar(const std::string& name, const Source& source) {
  for (const ScalarName& known : kScalarNames) {
    if (known.name == name) {
      return known.scalar;
    }
  }
  source.fail("'" + name + "' is no PLY type (char, uchar, short, ushort, int, uint, float, double)");
}

void addElement(const std::vector<std::string>& words, const Source& source, Header& header) {
  Element element;
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

void addProperty(const std::vector<std::string>& words, const Source& source, Header& header) {
  if (header.elements.empty()) {
    source.fail("a property before the first element");
  }
  Property property;
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

void setFormat(const std::vector<std::string>& words, const Source& source, Header& header) {
  const std::string format = words.size() > 1 ? words[1] : "";
  if (format != "ascii" && format != "binary_little_endian") {
    source.fail("format '" + format + "' is not supported (ascii, binary_little_endian)");
  }
  header.ascii = format == "ascii";
}

Header readHeader(Source& source) {
  if (source.nextLine() != "ply") {
    source.fail("not a PLY file: the first line must be 'ply'");
  }
  Header header;
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

/// Reads the values of one element, record by record.
class RecordReader {
 public:
  RecordReader(Source& source, const Header& header, const Element& element) : source_(source), ascii_(header.ascii), element_(element) {}

  /// Scalars land at their property's place in `scalars`, a list's values in `list` (the last list of the element wins).
  void read(std::vector<double>& scalars, std::vector<double>& list) {
    scalars.assign(element_.properties.size(), 0.0);
    for (std::size_t i = 0; i < element_.properties.size(); ++i) {
      const Property& property = element_.properties[i];
      if (property.list_count) {
        readList(property, list);
      } else {
        scalars[i] = next(property.scalar);
      }
    }
  }

 private:
  double next(Scalar scalar) { return ascii_ ? source_.nextAscii() : source_.nextBinary(scalar); }

  void readList(const Property& property, std::vector<double>& list) {
    const double count = next(*property.list_count);
    if (!(count >= 0.0) || count > static_cast<double>(source_.bytesLeft()) + 1e6) {
      source_.fail("a list of " + std::to_string(count) + " values");
    }
    list.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      list.push_back(next(property.scalar));
    }
  }

  Source& source_;
  bool ascii_;
  const Element& element_;
};

std::optional<std::size_t> findProperty(const Element& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name && !element.properties[i].list_count) {
      return i;
    }
  }
  return std::nullopt;
}

std::uint8_t toByte(double value, Scalar scalar) {
  const bool unit_range = scalar == Scalar::kFloat32 || scalar == Scalar::kFloat64;
  return static_cast<std::uint8_t>(std::lround(std::clamp(unit_range ? 255.0 * value : value, 0.0, 255.0)));
}

std::optional<std::array<std::size_t, 3>> findProperties(const Element& element, const std::array<std::string_view, 3>& names) {
  std::array<std::size_t, 3> places{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto place = findProperty(element, names[i]);
    if (!place) {
      return std::nullopt;
    }
    places[i] = *place;
  }
  return places;
}

void readVertices(Source& source, const Header& header, const Element& element, ColoredCloud& cloud) {
  const auto xyz = findProperties(element, {"x", "y", "z"});
  if (!xyz) {
    source.fail("element 'vertex' lacks x, y or z");
  }
  const auto rgb = findProperties(element, {"red", "green", "blue"});
  RecordReader reader(source, header, element);
  std::vector<double> values;
  std::vector<double> ignored;
  for (std::size_t i = 0; i < element.count; ++i) {
    reader.read(values, ignored);
    const Eigen::Vector3d point(values[(*xyz)[0]], values[(*xyz)[1]], values[(*xyz)[2]]);
    if (!point.allFinite()) {
      source.fail("vertex " + std::to_string(i) + " is not finite");
    }
    cloud.points.push_back(point.cast<float>());
    if (rgb) {
      const auto channel = [&](std::size_t c) { return toByte(values[(*rgb)[c]], element.properties[(*rgb)[c]].scalar); };
      cloud.colors.push_back({channel(0), channel(1), channel(2)});
    }
  }
}

void readTriangles(Source& source, const Header& header, const Element& element, ColoredMesh& mesh) {
  RecordReader reader(source, header, element);
  std::vector<double> ignored;
  std::vector<double> corners;
  for (std::size_t i = 0; i < element.count; ++i) {
    reader.read(ignored, corners);
    if (corners.size() != 3) {
      source.fail("face " + std::to_string(i) + " has " + std::to_string(corners.size()) + " corners, only triangles are read");
    }
    for (const double corner : corners) {
      if (!(corner >= 0.0) || corner >= static_cast<double>(mesh.vertices.points.size())) {
        source.fail("face " + std::to_string(i) + " names vertex " + std::to_string(corner) + ", which does not exist");
      }
    }
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]), static_cast<std::uint32_t>(corners[2])});
  }
}

void skipElement(Source& source, const Header& header, const Element& element) {
  RecordReader reader(source, header, element);
  std::vector<double> scalars;
  std::vector<double> list;
  // Records without a property take no bytes: their count may be any number.
  for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    reader.read(scalars, list);
  }
}

enum class Wanted { kVertices, kMesh };

ColoredMesh readBody(Source& source, const Header& header, Wanted wanted) {
  ColoredMesh mesh;
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      readVertices(source, header, element, mesh.vertices);
      has_vertices = true;
      if (wanted == Wanted::kVertices) {
        return mesh;
      }
    } else if (element.name == "face" && has_vertices) {
      readTriangles(source, header, element, mesh);
    } else {
      skipElement(source, header, element);
    }
  }
  if (!has_vertices) {
    source.fail("no element 'vertex'");
  }
  return mesh;
}

}  // namespace

ColoredCloud readPly(const std::filesystem::path& file) {
  Source source(file);
  const Header header = readHeader(source);
  return readBody(source, header, Wanted::kVertices).vertices;
}

ColoredMesh readPlyMesh(const std::filesystem::path& file) {
  Source source(file);
  const Header header = readHeader(source);
  return readBody(source, header, Wanted::kMesh);
}

}  // namespace oikos::geometry
