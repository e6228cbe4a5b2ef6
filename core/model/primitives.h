// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/model/triangle_mesh.h"

namespace oikos::model {

// Closed shapes around the origin, their triangles counter-clockwise seen from outside.

/// Twelve flat triangles; `size_m` from face to face.
[[nodiscard]] TriangleMesh makeBox(const Eigen::Vector3f& size_m);

/// About z, from -length/2 to length/2. Corners lie on the circle, the sides between them inside it by at most
/// radius * (1 - cos(pi / segments)). The mantle has the normals of the true cylinder.
struct CylinderShape {
  float radius_m = 0.5F;
  float length_m = 1.0F;
  int segments = 48;
};
[[nodiscard]] TriangleMesh makeCylinder(const CylinderShape& shape);

/// Rings of latitude about z, twice as many meridians; vertices lie on the sphere and have its normals.
struct SphereShape {
  float radius_m = 0.5F;
  int rings = 24;
};
[[nodiscard]] TriangleMesh makeSphere(const SphereShape& shape);

}  // namespace oikos::model
