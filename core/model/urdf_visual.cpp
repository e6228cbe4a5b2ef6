// SPDX-License-Identifier: Apache-2.0
#include "core/model/urdf_visual.h"

#include <urdf_model/link.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/model/primitives.h"
#include "core/model/urdf_document.h"

namespace oikos::model {

namespace {

bool isLength(double value) {
  return std::isfinite(static_cast<float>(value)) && static_cast<float>(value) > 0.0F;
}

void scale(TriangleMesh& mesh, const Eigen::Vector3f& factors) {
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex = vertex.cwiseProduct(factors);
  }
  for (Eigen::Vector3f& normal : mesh.normals) {
    normal = normal.cwiseQuotient(factors).normalized();
  }
  if (factors.prod() < 0.0F) {
    for (TriangleMesh::Triangle& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

}  // namespace

void UrdfVisuals::fail(const std::string& element, const std::string& what) const {
  throw base::Error(base::ErrorCode::kInput, element + " " + what, urdf_.string());
}

TriangleMesh UrdfVisuals::meshOf(const urdf::Link& link) {
  TriangleMesh mesh_link;
  const std::string element = "link '" + link.name + "'";
  for (const urdf::VisualSharedPtr& visual : link.visual_array) {
    if (!visual->geometry) {
      fail(element, "has a visual without a geometry");
    }
    TriangleMesh mesh_visual = shapeOf(*visual->geometry, element);
    if (visual->material) {
      paint(mesh_visual, *visual, element);
    }
    const Eigen::Isometry3d T_link_visual = toIsometry(visual->origin);
    if (!T_link_visual.matrix().allFinite()) {
      fail(element, "has a visual whose origin is not finite");
    }
    append(mesh_link, mesh_visual, T_link_visual);
  }
  return mesh_link;
}

TriangleMesh UrdfVisuals::shapeOf(const urdf::Geometry& geometry, const std::string& element) {
  const auto checked = [&](double length_m, const char* what) {
    if (!isLength(length_m)) {
      fail(element, std::string("has a shape with the ") + what + " " + base::toText(length_m) + ": must be more than 0");
    }
    return static_cast<float>(length_m);
  };
  switch (geometry.type) {
    case urdf::Geometry::BOX: {
      const urdf::Vector3& size = dynamic_cast<const urdf::Box&>(geometry).dim;
      return makeBox({checked(size.x, "size"), checked(size.y, "size"), checked(size.z, "size")});
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
      return makeCylinder({.radius_m = checked(cylinder.radius, "radius"), .length_m = checked(cylinder.length, "length")});
    }
    case urdf::Geometry::SPHERE:
      return makeSphere({.radius_m = checked(dynamic_cast<const urdf::Sphere&>(geometry).radius, "radius")});
    case urdf::Geometry::MESH:
      return scaledMesh(dynamic_cast<const urdf::Mesh&>(geometry), element);
  }
  fail(element, "has a visual of an unknown shape");
}

TriangleMesh UrdfVisuals::scaledMesh(const urdf::Mesh& mesh, const std::string& element) {
  const Eigen::Vector3f factors = Eigen::Vector3d(mesh.scale.x, mesh.scale.y, mesh.scale.z).cast<float>();
  if (!factors.allFinite() || factors.prod() == 0.0F) {
    fail(element, "has a mesh with a scale of 0 or one that is not finite");
  }
  TriangleMesh scaled = meshFile(mesh.filename, element);
  if (factors != Eigen::Vector3f::Ones()) {
    scale(scaled, factors);
  }
  return scaled;
}

const TriangleMesh& UrdfVisuals::meshFile(const std::string& name, const std::string& element) {
  const auto [entry, is_new] = meshes_.try_emplace(name);
  if (!is_new) {
    return entry->second;
  }
  if (name.find("://") != std::string::npos) {
    fail(element, "has the mesh '" + name + "': no packages are known here; must be a path relative to this file");
  }
  if (std::filesystem::path(name).is_absolute()) {
    fail(element, "has the mesh '" + name + "', an absolute path: must be relative to this file");
  }
  try {
    MeshFile read = readMesh(urdf_.parent_path() / name, limits_);
    for (const std::string& warning : read.warnings) {
      warnings_.push_back(element + ": mesh '" + name + "' " + warning);
    }
    entry->second = std::move(read.mesh_model);
  } catch (const base::Error& error) {
    // A mesh that the URDF names and that is not there is the URDF's fault.
    fail(element, "has a mesh that cannot be used: " + std::string(error.what()));
  }
  return entry->second;
}

void UrdfVisuals::paint(TriangleMesh& mesh, const urdf::Visual& visual, const std::string& element) {
  const urdf::Material& source = *visual.material;
  if (!source.texture_filename.empty()) {
    warnings_.push_back(element + ": the texture '" + source.texture_filename + "' of material '" + source.name + "' is left out");
    if (!mesh.materials.empty()) {
      return;
    }
  }
  Material material;
  material.name = source.name;
  material.color_rgb = Eigen::Vector3f(source.color.r, source.color.g, source.color.b).cwiseMax(0.0F).cwiseMin(1.0F);
  mesh.materials = {material};
  mesh.triangle_materials.clear();
  mesh.vertex_colors.clear();
}

}  // namespace oikos::model
