// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/geometry/point_cloud.h"

namespace oikos::geometry {

/// Reads the vertices of a PLY file ("PLY - Polygon File Format", Greg Turk 1994): ascii or binary little-endian, x y z of any
/// scalar type, red green blue as integers (taken as 0..255) or floats (0..1) where the file has them; everything else is
/// passed over. Throws Error{kIo} when the file cannot be read and Error{kInput} with line (header, ascii) or byte offset
/// (binary) when it is not what it says, has no vertices' coordinates, or a coordinate is not finite.
[[nodiscard]] ColoredCloud readPly(const std::filesystem::path& file);

/// As readPly, with the triangles of element `face` (`vertex_indices` or `vertex_index`); other polygons, and indices that
/// point nowhere, are an Error{kInput}.
[[nodiscard]] ColoredMesh readPlyMesh(const std::filesystem::path& file);

/// Writes a coloured cloud point by point, for clouds that need not be held as one. Atomic; throws Error{kIo}.
class PlyCloudWriter {
 public:
  PlyCloudWriter(const std::filesystem::path& file, std::size_t point_count);
  void add(const Eigen::Vector3f& point, const Rgb& color);
  /// Throws ContractViolation if not as many points came as were announced.
  void commit();

 private:
  base::AtomicFile target_;
  std::size_t missing_;
};

/// Binary little-endian, `float x y z` and, with colours, `uchar red green blue`. Atomic; throws Error{kIo}.
void writePly(const ColoredCloud& cloud, const std::filesystem::path& file);
void writePly(const ColoredMesh& mesh, const std::filesystem::path& file);

}  // namespace oikos::geometry
