// SPDX-License-Identifier: Apache-2.0
#include "core/render/surface_table.h"

#include <algorithm>
#include <cmath>

namespace oikos::render {

namespace {

void addTexture(const model::TriangleMesh& mesh, const model::TriangleMesh::Triangle& corners, double area_sq_m, SurfaceTriangle& surface) {
  surface.texture_origin = mesh.texture_coordinates[corners[0]];
  surface.texture_along_u = mesh.texture_coordinates[corners[1]] - surface.texture_origin;
  surface.texture_along_v = mesh.texture_coordinates[corners[2]] - surface.texture_origin;
  const cv::Mat& texture = mesh.materials[surface.material].texture;
  const Eigen::Vector2f& first = surface.texture_along_u;
  const Eigen::Vector2f& second = surface.texture_along_v;
  const float texels =
      std::abs(first.x() * second.y() - first.y() * second.x()) * static_cast<float>(texture.cols) * static_cast<float>(texture.rows);
  surface.texels_per_m = std::max(1e-6F, std::sqrt(texels / std::max(static_cast<float>(area_sq_m), 1e-12F)));
}

}  // namespace

std::vector<SurfaceTriangle> makeSurfaceTable(const model::TriangleMesh& mesh_part) {
  std::vector<SurfaceTriangle> surfaces(mesh_part.triangles.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    SurfaceTriangle& surface = surfaces[i];
    const model::TriangleMesh::Triangle& corners = mesh_part.triangles[i];
    const Eigen::Vector3d across = mesh_part.areaNormal(i);
    const double area_sq_m = across.norm();  // twice the triangle's, as below in the texture
    if (area_sq_m > 0.0) {
      surface.normal_part = across / area_sq_m;
      surface.offset_m = surface.normal_part.dot(mesh_part.vertices[corners[0]].cast<double>());
    }
    surface.material = mesh_part.triangle_materials.empty() ? 0 : mesh_part.triangle_materials[i];
    if (!mesh_part.texture_coordinates.empty() && !mesh_part.materials.empty() && !mesh_part.materials[surface.material].texture.empty()) {
      addTexture(mesh_part, corners, area_sq_m, surface);
    }
  }
  return surfaces;
}

}  // namespace oikos::render
