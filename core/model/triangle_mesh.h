// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as a plain value: what a CAD file holds and what a renderer draws.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace oikos::model {

/// How a surface looks. Colours are as a screen shows them (sRGB), 0 to 1.
struct Material {
  std::string name;
  Eigen::Vector3f color_rgb = Eigen::Vector3f::Constant(0.7F);
  float gloss = 0.0F;  ///< 0 matt to 1 mirror or glass
  cv::Mat texture;     ///< CV_8UC3, BGR, multiplied with the colour; empty: none. Copies of a material share its pixels.
};

/// Triangles over shared vertices, counter-clockwise seen from outside. The variable that holds one names the frame (`mesh_part`).
struct TriangleMesh {
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<Eigen::Vector3f> vertices;             ///< metres
  std::vector<Eigen::Vector3f> normals;              ///< one a vertex, of length 1; or none: the surface is flat triangles
  std::vector<Eigen::Vector2f> texture_coordinates;  ///< one a vertex, (0, 0) the lower left corner of the texture; or none
  std::vector<geometry::Rgb> vertex_colors;          ///< one a vertex, multiplied with the material; or none
  std::vector<Triangle> triangles;                   ///< indices into `vertices`
  std::vector<std::uint32_t> triangle_materials;     ///< one a triangle, an index into `materials`; or none: the first
  std::vector<Material> materials;                   ///< or none: `Material{}`

  [[nodiscard]] bool empty() const { return triangles.empty(); }
  /// Of the vertices that a triangle uses; empty for an empty mesh.
  [[nodiscard]] Eigen::AlignedBox3f bounds() const;
  [[nodiscard]] const Material& materialOf(std::size_t triangle) const;
  /// Across the triangle, not normalised: its length is twice the triangle's area.
  [[nodiscard]] Eigen::Vector3d areaNormal(std::size_t triangle) const;
};

/// What is wrong with a mesh, one line each: lists that do not fit together, indices out of range, numbers that are not finite.
[[nodiscard]] std::vector<std::string> validate(const TriangleMesh& mesh);

/// Adds `other`, moved by `T_mesh_other`. What only one of the two has (normals, texture coordinates, colours) is filled up so that the
/// surfaces look as they did: a mesh without normals gets its corners split.
void append(TriangleMesh& mesh, const TriangleMesh& other, const Eigen::Isometry3d& T_mesh_other);

/// The same surface with a normal at every vertex; corners that met in one vertex are split, so that the triangles stay flat.
[[nodiscard]] TriangleMesh withFlatNormals(const TriangleMesh& mesh);

}  // namespace oikos::model
