// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/point_cloud.h"
#include "mapping/volume/tsdf_volume.h"

namespace oikos::mapping {

/// The zero surface of the distances as triangles with shared, coloured vertices, counter-clockwise seen from free space
/// (Lorensen & Cline, "Marching Cubes", SIGGRAPH 1987). Bricks are gone through in ascending order of their keys: the same mesh
/// for any number of threads.
[[nodiscard]] geometry::ColoredMesh extractMesh(const TsdfVolume& volume, int threads);

/// Takes away connected pieces of fewer triangles, and vertices that no triangle uses. Keeps the order of what stays.
void removeSpecks(int min_triangles, geometry::ColoredMesh& mesh);

}  // namespace oikos::mapping
