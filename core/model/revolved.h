// SPDX-License-Identifier: Apache-2.0
// Closed shapes that a line draws when it is led around: about an axis (cups, bottles, tubes), or along an arc (handles).
#pragma once

#include <vector>

#include "core/model/primitives.h"

namespace oikos::model {

/// A corner of the line that is turned about z.
struct ProfilePoint {
  float radius_m = 0.0F;
  float z_m = 0.0F;
  int material = 0;  ///< of the surface from here to the next point: an index into the mesh's materials
};

/// The line leads from the axis, below, outwards and up, and back to the axis; or round a hole, the last point the first again. Either way
/// what is solid lies on its left. Corners of less than 45 degrees are shaded smoothly.
/// Texture: surfaces that lie nearly flat (within 25 degrees) are mapped from above or below, their disc's square being the whole image.
/// On the others u runs once around, counter-clockwise seen from above, with the middle of the image at +x, and v follows the line upwards
/// (on inner surfaces too), from 0 to 1 over each run of one material. At the scale of metres u is measured at the run's greatest radius.
struct RevolvedShape {
  std::vector<ProfilePoint> profile;
  int segments = 48;
  TextureScale scale = TextureScale::kMetres;
};
[[nodiscard]] TriangleMesh makeRevolved(const RevolvedShape& shape);

/// A cone's trunk about z, from z = 0 to its height; caps are material 1, the mantle 0.
struct TaperedCylinderShape {
  float bottom_radius_m = 0.5F;
  float top_radius_m = 0.4F;
  float height_m = 1.0F;
  int segments = 48;
};
[[nodiscard]] TriangleMesh makeTaperedCylinder(const TaperedCylinderShape& shape, TextureScale scale = TextureScale::kMetres);

/// Open at both ends, from z = 0 to its height; `bottom_radius_m` and `top_radius_m` are the outer ones.
struct TubeShape {
  float bottom_radius_m = 0.5F;
  float top_radius_m = 0.5F;
  float height_m = 1.0F;
  float wall_m = 0.1F;
  int segments = 48;
};
[[nodiscard]] TriangleMesh makeTube(const TubeShape& shape, TextureScale scale = TextureScale::kMetres);

/// A round rod that is bent along an arc about y: its centre line leads from `from_rad` to `to_rad`, measured from +x towards +z.
/// Texture at metres: u along the rod, v around it.
struct BentRodShape {
  float arc_radius_m = 0.03F;
  float rod_radius_m = 0.005F;
  float from_rad = 0.0F;
  float to_rad = 3.14159265F;
  int segments = 16;  ///< along the arc
  int sides = 10;     ///< around the rod
};
[[nodiscard]] TriangleMesh makeBentRod(const BentRodShape& shape);

}  // namespace oikos::model
