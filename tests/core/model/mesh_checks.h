// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::test {

/// By the divergence theorem; positive only if the triangles are counter-clockwise seen from outside.
inline double volumeM3(const model::TriangleMesh& mesh) {
  double volume_m3 = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    volume_m3 += mesh.vertices[mesh.triangles[i][0]].cast<double>().dot(mesh.areaNormal(i)) / 6.0;
  }
  return volume_m3;
}

/// Edges, by where their ends are, that are not run through as often in one direction as in the other. A closed surface has none.
inline int openEdges(const model::TriangleMesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> balance;
  const auto place = [&](std::uint32_t vertex) {
    const Eigen::Vector3f& v = mesh.vertices[vertex];
    return Place{v.x() + 0.0F, v.y() + 0.0F, v.z() + 0.0F};  // no negative zero
  };
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Place a = place(triangle[i]);
      const Place b = place(triangle[(i + 1) % 3]);
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  int open = 0;
  for (const auto& [edge, count] : balance) {
    open += count != 0 ? 1 : 0;
  }
  return open;
}

/// Triangles whose vertices' normals do not look to the side that the triangle's order gives. `min_cosine` leaves room for rounding.
inline int wrongNormals(const model::TriangleMesh& mesh, double min_cosine) {
  int wrong = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3d normal = mesh.areaNormal(i).normalized();
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      const Eigen::Vector3d given = mesh.normals[vertex].cast<double>();
      wrong += given.dot(normal) >= min_cosine && std::abs(given.norm() - 1.0) < 1e-5 ? 0 : 1;
    }
  }
  return wrong;
}

/// Of all parts at these joint values; with `material`, of its triangles only.
inline Eigen::AlignedBox3d boundsAt(const model::ArticulatedModel& model, const std::vector<double>& joint_values,
                                    const std::string& material = {}) {
  const auto T_model_part = model::Kinematics(model).solve(joint_values);
  Eigen::AlignedBox3d bounds;
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    const model::TriangleMesh& mesh = *model.parts[part].mesh_part;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (const std::uint32_t vertex : mesh.triangles[i]) {
        if (material.empty() || mesh.materialOf(i).name == material) {
          bounds.extend(T_model_part[part] * mesh.vertices[vertex].cast<double>());
        }
      }
    }
  }
  return bounds;
}

/// The boxes (12 triangles over 24 vertices of their own, flat and along the axes) that a mesh is made of; other shapes are left out.
inline std::vector<Eigen::AlignedBox3d> boxesOf(const model::TriangleMesh& mesh) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t i = 0; i + 12 <= mesh.triangles.size();) {
    const std::uint32_t first = mesh.triangles[i][0];
    const std::array<std::uint32_t, 3> last = {first + 20, first + 22, first + 23};
    bool is_box = mesh.triangles[i + 11] == last;
    for (std::uint32_t vertex = first; is_box && vertex < first + 24; ++vertex) {
      is_box = mesh.normals[vertex].cwiseAbs().maxCoeff() == 1.0F;
    }
    if (!is_box) {
      ++i;
      continue;
    }
    Eigen::AlignedBox3d box;
    for (std::uint32_t vertex = first; vertex < first + 24; ++vertex) {
      box.extend(mesh.vertices[vertex].cast<double>());
    }
    boxes.push_back(box);
    i += 12;
  }
  return boxes;
}

}  // namespace oikos::test
