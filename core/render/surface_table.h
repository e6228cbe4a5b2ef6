// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::render {

/// A triangle as the renderer asks for it at every pixel, worked out once.
struct SurfaceTriangle {
  Eigen::Vector3d normal_part = Eigen::Vector3d::Zero();  ///< length 1; 0 if the triangle has no area
  double offset_m = 0.0;                                  ///< normal · corner
  Eigen::Vector2f texture_origin = Eigen::Vector2f::Zero();
  Eigen::Vector2f texture_along_u = Eigen::Vector2f::Zero();  ///< by the barycentric coordinates u and v
  Eigen::Vector2f texture_along_v = Eigen::Vector2f::Zero();
  float texels_per_m = 0.0F;  ///< in the mean over all directions; 0: without a texture
  std::uint32_t material = 0;
};

/// One a triangle.
[[nodiscard]] std::vector<SurfaceTriangle> makeSurfaceTable(const model::TriangleMesh& mesh_part);

}  // namespace oikos::render
