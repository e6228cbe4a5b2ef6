// SPDX-License-Identifier: Apache-2.0
// Closed shapes, their triangles counter-clockwise seen from outside, with normals and texture coordinates.
#pragma once

#include "core/model/triangle_mesh.h"

namespace oikos::model {

/// What a texture coordinate of 1 means. Images stand upright on upright faces, seen from outside, with z up; on the top face they read
/// from +x, on the bottom face as if the shape had been tipped over backwards.
enum class TextureScale {
  kMetres,  ///< 1 is one metre along the surface, (0, 0) each face's lower left corner: for grain and tiles
  kWhole,   ///< each face of a box, and the mantle and the caps of a round shape, show the whole image once
};

/// Twelve flat triangles around the origin; `size_m` from face to face.
[[nodiscard]] TriangleMesh makeBox(const Eigen::Vector3f& size_m, TextureScale scale = TextureScale::kMetres);

/// The same where it stands; the faces lie exactly on `bounds_m`.
[[nodiscard]] TriangleMesh makeBoxBetween(const Eigen::AlignedBox3f& bounds_m, TextureScale scale = TextureScale::kMetres);

/// About z, from -length/2 to length/2. Corners lie on the circle, the sides between them inside it by at most
/// radius * (1 - cos(pi / segments)). The mantle has the normals of the true cylinder.
struct CylinderShape {
  float radius_m = 0.5F;
  float length_m = 1.0F;
  int segments = 48;
};
[[nodiscard]] TriangleMesh makeCylinder(const CylinderShape& shape, TextureScale scale = TextureScale::kMetres);

/// Rings of latitude about z, twice as many meridians; vertices lie on the sphere and have its normals. Textures wrap once around from
/// the meridian at -x, upright, at either scale's unit measured along the equator and along a meridian.
struct SphereShape {
  float radius_m = 0.5F;
  int rings = 24;
};
[[nodiscard]] TriangleMesh makeSphere(const SphereShape& shape, TextureScale scale = TextureScale::kMetres);

/// A box around the origin whose edges and corners are rounded, in `steps` facets a quarter turn; its outermost faces lie on `size_m`.
/// Textures are those of the box that it was cut from.
struct RoundedBoxShape {
  Eigen::Vector3f size_m = Eigen::Vector3f::Ones();
  float radius_m = 0.1F;  ///< less than half of the least side
  int steps = 3;
};
[[nodiscard]] TriangleMesh makeRoundedBox(const RoundedBoxShape& shape);

}  // namespace oikos::model
