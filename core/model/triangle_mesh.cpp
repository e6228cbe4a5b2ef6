// SPDX-License-Identifier: Apache-2.0
#include "core/model/triangle_mesh.h"

#include <algorithm>

namespace oikos::model {

namespace {

const geometry::Rgb kWhite = {255, 255, 255};

template <typename Value>
std::vector<Value> perCorner(const TriangleMesh& mesh, const std::vector<Value>& values) {
  std::vector<Value> result;
  for (const TriangleMesh::Triangle& triangle : values.empty() ? std::vector<TriangleMesh::Triangle>{} : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      result.push_back(values[vertex]);
    }
  }
  return result;
}

/// Appends `other`'s values; a list that is missing is taken to be full of `filler`, unless both are missing.
template <typename Value>
void appendValues(std::vector<Value>& values, std::size_t count, const std::vector<Value>& other, std::size_t other_count,
                  const Value& filler) {
  if (values.empty() && other.empty()) {
    return;
  }
  if (values.empty()) {
    values.assign(count, filler);
  }
  if (other.empty()) {
    values.resize(count + other_count, filler);
  } else {
    values.insert(values.end(), other.begin(), other.end());
  }
}

void appendMaterials(TriangleMesh& mesh, const TriangleMesh& other) {
  mesh.triangle_materials.resize(mesh.triangles.size(), 0);
  if (mesh.materials.empty() && !mesh.triangles.empty()) {
    mesh.materials.emplace_back();
  }
  const auto first = static_cast<std::uint32_t>(mesh.materials.size());
  for (std::size_t i = 0; i < other.triangles.size(); ++i) {
    mesh.triangle_materials.push_back(first + (other.triangle_materials.empty() ? 0 : other.triangle_materials[i]));
  }
  mesh.materials.insert(mesh.materials.end(), other.materials.begin(), other.materials.end());
  if (other.materials.empty()) {
    mesh.materials.emplace_back();
  }
}

void appendSurface(TriangleMesh& mesh, const TriangleMesh& other, const Eigen::Isometry3d& T_mesh_other) {
  appendMaterials(mesh, other);
  const std::size_t count = mesh.vertices.size();
  const std::size_t other_count = other.vertices.size();
  appendValues(mesh.texture_coordinates, count, other.texture_coordinates, other_count, Eigen::Vector2f(0.0F, 0.0F));
  appendValues(mesh.vertex_colors, count, other.vertex_colors, other_count, kWhite);
  for (const Eigen::Vector3f& vertex : other.vertices) {
    mesh.vertices.push_back((T_mesh_other * vertex.cast<double>()).cast<float>());
  }
  for (const Eigen::Vector3f& normal : other.normals) {
    mesh.normals.push_back((T_mesh_other.linear() * normal.cast<double>()).cast<float>());
  }
  for (const TriangleMesh::Triangle& triangle : other.triangles) {
    const auto first = static_cast<std::uint32_t>(count);
    mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
}

template <typename Value>
void checkCount(std::vector<std::string>& problems, const char* what, const std::vector<Value>& values, std::size_t expected) {
  if (!values.empty() && values.size() != expected) {
    problems.push_back(std::string(what) + ": " + std::to_string(values.size()) + " values: must be none or " + std::to_string(expected));
  }
}

template <typename Vector>
void checkFinite(std::vector<std::string>& problems, const char* what, const std::vector<Vector>& values) {
  const auto bad = std::find_if(values.begin(), values.end(), [](const Vector& value) { return !value.allFinite(); });
  if (bad != values.end()) {
    problems.push_back(std::string(what) + ": number " + std::to_string(bad - values.begin()) + " is not finite");
  }
}

void checkTriangles(std::vector<std::string>& problems, const TriangleMesh& mesh) {
  const auto is_outside = [&](const TriangleMesh::Triangle& triangle) {
    return *std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size();
  };
  const auto bad = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), is_outside);
  if (bad != mesh.triangles.end()) {
    problems.push_back("triangle " + std::to_string(bad - mesh.triangles.begin()) + " has a vertex that does not exist: there are " +
                       std::to_string(mesh.vertices.size()));
  }
  const std::size_t materials = std::max<std::size_t>(mesh.materials.size(), 1);
  if (std::any_of(mesh.triangle_materials.begin(), mesh.triangle_materials.end(), [&](std::uint32_t m) { return m >= materials; })) {
    problems.push_back("a triangle has a material that does not exist: there are " + std::to_string(mesh.materials.size()));
  }
}

}  // namespace

Eigen::AlignedBox3f TriangleMesh::bounds() const {
  Eigen::AlignedBox3f box;
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      box.extend(vertices[vertex]);
    }
  }
  return box;
}

const Material& TriangleMesh::materialOf(std::size_t triangle) const {
  static const Material plain;
  if (materials.empty()) {
    return plain;
  }
  return materials[triangle_materials.empty() ? 0 : triangle_materials[triangle]];
}

Eigen::Vector3d TriangleMesh::areaNormal(std::size_t triangle) const {
  const auto& [a, b, c] = triangles[triangle];
  const Eigen::Vector3d corner = vertices[a].cast<double>();
  return (vertices[b].cast<double>() - corner).cross(vertices[c].cast<double>() - corner);
}

std::vector<std::string> validate(const TriangleMesh& mesh) {
  std::vector<std::string> problems;
  checkCount(problems, "normals", mesh.normals, mesh.vertices.size());
  checkCount(problems, "texture coordinates", mesh.texture_coordinates, mesh.vertices.size());
  checkCount(problems, "vertex colours", mesh.vertex_colors, mesh.vertices.size());
  checkCount(problems, "triangle materials", mesh.triangle_materials, mesh.triangles.size());
  checkFinite(problems, "vertices", mesh.vertices);
  checkFinite(problems, "normals", mesh.normals);
  checkFinite(problems, "texture coordinates", mesh.texture_coordinates);
  checkTriangles(problems, mesh);
  return problems;
}

TriangleMesh withFlatNormals(const TriangleMesh& mesh) {
  TriangleMesh flat;
  flat.materials = mesh.materials;
  flat.triangle_materials = mesh.triangle_materials;
  flat.vertices = perCorner(mesh, mesh.vertices);
  flat.texture_coordinates = perCorner(mesh, mesh.texture_coordinates);
  flat.vertex_colors = perCorner(mesh, mesh.vertex_colors);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    flat.normals.insert(flat.normals.end(), 3, mesh.areaNormal(i).normalized().cast<float>());
    const auto first = static_cast<std::uint32_t>(3 * i);
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  return flat;
}

void append(TriangleMesh& mesh, const TriangleMesh& other, const Eigen::Isometry3d& T_mesh_other) {
  if (mesh.normals.empty() != other.normals.empty() && !mesh.empty() && !other.empty()) {
    if (mesh.normals.empty()) {
      mesh = withFlatNormals(mesh);
    } else {
      appendSurface(mesh, withFlatNormals(other), T_mesh_other);
      return;
    }
  }
  appendSurface(mesh, other, T_mesh_other);
}

}  // namespace oikos::model
