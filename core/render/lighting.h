// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace oikos::render {

/// A lamp that shines evenly in all directions.
struct PointLight {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();
  Eigen::Vector3f intensity_rgb = Eigen::Vector3f::Ones();  ///< linear; a white wall 1 m before it, facing it, gets this brightness
  float reach_m = 1e6F;                                     ///< where its light has faded out: what is farther away costs nothing
};

/// Light of a home: a glow from all sides, stronger from above, and lamps. Brightness 1 is white in the picture.
struct Lighting {
  Eigen::Vector3f from_above_rgb = Eigen::Vector3f::Constant(0.45F);  ///< linear, on a white surface that faces up
  Eigen::Vector3f from_below_rgb = Eigen::Vector3f::Constant(0.25F);  ///< on one that faces down
  std::vector<PointLight> lamps;
  bool has_shadows = true;  ///< of the lamps
};

}  // namespace oikos::render
