// SPDX-License-Identifier: Apache-2.0
#include "core/model/primitives.h"

#include <cmath>
#include <numbers>

#include "core/base/error.h"

namespace oikos::model {

namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// On the circle about z of radius 1.
Eigen::Vector3f onCircle(int index, int count) {
  const double angle_rad = kTurn_rad * index / count;
  return {static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)), 0.0F};
}

std::uint32_t addVertex(TriangleMesh& mesh, const Eigen::Vector3f& vertex, const Eigen::Vector3f& normal) {
  mesh.vertices.push_back(vertex);
  mesh.normals.push_back(normal);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void addMantle(TriangleMesh& mesh, const CylinderShape& shape) {
  const Eigen::Vector3f half = Eigen::Vector3f::UnitZ() * shape.length_m / 2.0F;
  for (int i = 0; i < shape.segments; ++i) {
    const Eigen::Vector3f outward = onCircle(i, shape.segments);
    addVertex(mesh, outward * shape.radius_m - half, outward);
    addVertex(mesh, outward * shape.radius_m + half, outward);
  }
  const auto count = static_cast<std::uint32_t>(2 * shape.segments);
  for (std::uint32_t i = 0; i < count; i += 2) {
    const std::uint32_t next = (i + 2) % count;
    mesh.triangles.push_back({i, next, next + 1});
    mesh.triangles.push_back({i, next + 1, i + 1});
  }
}

void addCap(TriangleMesh& mesh, const CylinderShape& shape, float side) {
  const Eigen::Vector3f normal = Eigen::Vector3f::UnitZ() * side;
  const Eigen::Vector3f middle = normal * shape.length_m / 2.0F;
  const std::uint32_t centre = addVertex(mesh, middle, normal);
  for (int i = 0; i < shape.segments; ++i) {
    addVertex(mesh, onCircle(i, shape.segments) * shape.radius_m + middle, normal);
  }
  const auto count = static_cast<std::uint32_t>(shape.segments);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = centre + 1 + i;
    const std::uint32_t next = centre + 1 + (i + 1) % count;
    mesh.triangles.push_back(side > 0.0F ? TriangleMesh::Triangle{centre, here, next} : TriangleMesh::Triangle{centre, next, here});
  }
}

/// From the south pole (0) to the north pole (`rings`); at the poles a vertex for each meridian.
void addRing(TriangleMesh& mesh, const SphereShape& shape, int ring) {
  const double latitude_rad = std::numbers::pi * (static_cast<double>(ring) / shape.rings - 0.5);
  for (int i = 0; i < 2 * shape.rings; ++i) {
    Eigen::Vector3f outward = onCircle(i, 2 * shape.rings) * static_cast<float>(std::cos(latitude_rad));
    outward.z() = static_cast<float>(std::sin(latitude_rad));
    addVertex(mesh, outward * shape.radius_m, outward.normalized());
  }
}

void addBelt(TriangleMesh& mesh, const SphereShape& shape, int ring) {
  const auto meridians = static_cast<std::uint32_t>(2 * shape.rings);
  const std::uint32_t lower = static_cast<std::uint32_t>(ring) * meridians;
  const std::uint32_t upper = lower + meridians;
  for (std::uint32_t i = 0; i < meridians; ++i) {
    const std::uint32_t next = (i + 1) % meridians;
    if (ring > 0) {
      mesh.triangles.push_back({lower + i, lower + next, upper + next});
    }
    if (ring + 1 < shape.rings) {
      mesh.triangles.push_back({lower + i, upper + next, upper + i});
    }
  }
}

}  // namespace

TriangleMesh makeBox(const Eigen::Vector3f& size_m) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const Eigen::Vector3f normal = Eigen::Vector3f::Unit(axis) * side;
      const Eigen::Vector3f along = Eigen::Vector3f::Unit((axis + 1) % 3);
      const Eigen::Vector3f across = normal.cross(along);
      std::uint32_t first = 0;
      for (const auto& [a, b] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
        const std::uint32_t added = addVertex(mesh, (normal + a * along + b * across).cwiseProduct(size_m) / 2.0F, normal);
        mesh.texture_coordinates.emplace_back((a + 1.0F) / 2.0F, (b + 1.0F) / 2.0F);
        first = added - added % 4;
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh;
}

TriangleMesh makeCylinder(const CylinderShape& shape) {
  OIKOS_CHECK(shape.segments >= 3);
  TriangleMesh mesh;
  addMantle(mesh, shape);
  addCap(mesh, shape, 1.0F);
  addCap(mesh, shape, -1.0F);
  return mesh;
}

TriangleMesh makeSphere(const SphereShape& shape) {
  OIKOS_CHECK(shape.rings >= 2);
  TriangleMesh mesh;
  for (int ring = 0; ring <= shape.rings; ++ring) {
    addRing(mesh, shape, ring);
  }
  for (int ring = 0; ring < shape.rings; ++ring) {
    addBelt(mesh, shape, ring);
  }
  return mesh;
}

}  // namespace oikos::model
