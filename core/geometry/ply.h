// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

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

/// Binary little-endian, `float x y z` and, with colours, `uchar red green blue`. Atomic; throws Error{kIo}.
void writePly(const ColoredCloud& cloud, const std::filesystem::path& file);
void writePly(const ColoredMesh& mesh, const std::filesystem::path& file);

}  // namespace oikos::geometry
