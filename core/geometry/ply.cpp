// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/ply_header.h"

namespace oikos::geometry {

namespace {

/// Reads the values of one element, record by record.
class RecordReader {
 public:
  RecordReader(PlySource& source, const PlyHeader& header, const PlyElement& element)
      : source_(source), ascii_(header.ascii), element_(element) {}

  /// Scalars land at their property's place in `scalars`, a list's values in `list` (the last list of the element wins).
  void read(std::vector<double>& scalars, std::vector<double>& list) {
    scalars.assign(element_.properties.size(), 0.0);
    for (std::size_t i = 0; i < element_.properties.size(); ++i) {
      const PlyProperty& property = element_.properties[i];
      if (property.list_count) {
        readList(property, list);
      } else {
        scalars[i] = next(property.scalar);
      }
    }
  }

 private:
  double next(PlyScalar scalar) { return ascii_ ? source_.nextAscii() : source_.nextBinary(scalar); }

  void readList(const PlyProperty& property, std::vector<double>& list) {
    const double count = next(*property.list_count);
    if (!(count >= 0.0) || count > static_cast<double>(source_.bytesLeft()) + 1e6) {
      source_.fail("a list of " + std::to_string(count) + " values");
    }
    list.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      list.push_back(next(property.scalar));
    }
  }

  PlySource& source_;
  bool ascii_;
  const PlyElement& element_;
};

std::optional<std::size_t> findProperty(const PlyElement& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name && !element.properties[i].list_count) {
      return i;
    }
  }
  return std::nullopt;
}

std::uint8_t toByte(double value, PlyScalar scalar) {
  const bool unit_range = scalar == PlyScalar::kFloat32 || scalar == PlyScalar::kFloat64;
  return static_cast<std::uint8_t>(std::lround(std::clamp(unit_range ? 255.0 * value : value, 0.0, 255.0)));
}

std::optional<std::array<std::size_t, 3>> findProperties(const PlyElement& element, const std::array<std::string_view, 3>& names) {
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

void readVertices(PlySource& source, const PlyHeader& header, const PlyElement& element, ColoredCloud& cloud) {
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

void readTriangles(PlySource& source, const PlyHeader& header, const PlyElement& element, ColoredMesh& mesh) {
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

void skipElement(PlySource& source, const PlyHeader& header, const PlyElement& element) {
  RecordReader reader(source, header, element);
  std::vector<double> scalars;
  std::vector<double> list;
  // Records without a property take no bytes: their count may be any number.
  for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    reader.read(scalars, list);
  }
}

enum class Wanted { kVertices, kMesh };

ColoredMesh readBody(PlySource& source, const PlyHeader& header, Wanted wanted) {
  ColoredMesh mesh;
  bool has_vertices = false;
  for (const PlyElement& element : header.elements) {
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
  PlySource source(file);
  const PlyHeader header = readPlyHeader(source);
  return readBody(source, header, Wanted::kVertices).vertices;
}

ColoredMesh readPlyMesh(const std::filesystem::path& file) {
  PlySource source(file);
  const PlyHeader header = readPlyHeader(source);
  return readBody(source, header, Wanted::kMesh);
}

}  // namespace oikos::geometry
