// SPDX-License-Identifier: Apache-2.0
#include "core/model/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.h"
#include "core/model/revolved.h"

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

/// From the south pole (0) to the north pole (`rings`), from -x round to -x; at the poles a vertex for each meridian.
void addRing(TriangleMesh& mesh, const SphereShape& shape, int ring) {
  const int meridians = 2 * shape.rings;
  const double latitude_rad = std::numbers::pi * (static_cast<double>(ring) / shape.rings - 0.5);
  const bool is_pole = ring == 0 || ring == shape.rings;  // exactly one point, so that the surface is closed
  const float level = is_pole ? 0.0F : static_cast<float>(std::cos(latitude_rad));
  for (int i = 0; i <= meridians; ++i) {
    Eigen::Vector3f outward = -onCircle(i % meridians, meridians) * level;
    outward.z() = static_cast<float>(std::sin(latitude_rad));
    addVertex(mesh, outward * shape.radius_m, outward.normalized());
    mesh.texture_coordinates.emplace_back(static_cast<float>(i) / static_cast<float>(meridians),
                                          static_cast<float>(ring) / static_cast<float>(shape.rings));
  }
}

void addBelt(TriangleMesh& mesh, const SphereShape& shape, int ring) {
  const auto meridians = static_cast<std::uint32_t>(2 * shape.rings);
  const std::uint32_t lower = static_cast<std::uint32_t>(ring) * (meridians + 1);
  const std::uint32_t upper = lower + meridians + 1;
  for (std::uint32_t i = 0; i < meridians; ++i) {
    if (ring > 0) {
      mesh.triangles.push_back({lower + i, lower + i + 1, upper + i + 1});
    }
    if (ring + 1 < shape.rings) {
      mesh.triangles.push_back({lower + i, upper + i + 1, upper + i});
    }
  }
}

/// Of a face with this outward normal: where the image's right and its upper edge point to.
struct FaceAxes {
  Eigen::Vector3f normal;
  Eigen::Vector3f right;
  Eigen::Vector3f up;
};

FaceAxes faceAxes(int axis, float side) {
  const Eigen::Vector3f normal = Eigen::Vector3f::Unit(axis) * side;
  const Eigen::Vector3f up = axis == 2 ? Eigen::Vector3f(-side, 0.0F, 0.0F) : Eigen::Vector3f::UnitZ();
  return {normal, up.cross(normal), up};
}

constexpr std::array<std::pair<float, float>, 4> kFaceCorners = {{{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}};

void addFace(TriangleMesh& mesh, const Eigen::AlignedBox3f& bounds_m, const FaceAxes& face, TextureScale scale) {
  const Eigen::Vector3f size_m = bounds_m.sizes();
  const Eigen::Vector2f extent = scale == TextureScale::kWhole
                                     ? Eigen::Vector2f::Ones().eval()
                                     : Eigen::Vector2f(std::fabs(face.right.dot(size_m)), std::fabs(face.up.dot(size_m)));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& [a, b] : kFaceCorners) {
    const Eigen::Vector3f corner = face.normal + a * face.right + b * face.up;
    addVertex(mesh, (corner.array() > 0.0F).select(bounds_m.max(), bounds_m.min()), face.normal);
    mesh.texture_coordinates.emplace_back((a + 1.0F) / 2.0F * extent.x(), (b + 1.0F) / 2.0F * extent.y());
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// Where the lines of a rounded box's faces run, along one axis from end to end: `steps` in each corner and one stretch between.
std::vector<double> gridLines(double half_m, double radius_m, int steps) {
  std::vector<double> lines;
  lines.push_back(half_m);
  for (int i = 0; i < steps; ++i) {
    // The tangent spaces the facets evenly: the corner's surface is the cube's, pushed out to the sphere.
    lines.push_back(half_m - radius_m * (1.0 - std::tan(std::numbers::pi / 4.0 * i / steps)));
  }
  for (std::size_t i = 0; i <= static_cast<std::size_t>(steps); ++i) {
    lines.push_back(-lines[i]);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

void addRoundedVertex(TriangleMesh& mesh, const RoundedBoxShape& shape, const Eigen::Vector3d& cube_point) {
  const Eigen::Vector3d core = (shape.size_m.cast<double>() / 2.0).array() - static_cast<double>(shape.radius_m);
  const Eigen::Vector3d inner = cube_point.cwiseMax(-core).cwiseMin(core);
  const Eigen::Vector3d outward = (cube_point - inner).normalized();
  addVertex(mesh, (inner + static_cast<double>(shape.radius_m) * outward).cast<float>(), outward.cast<float>());
}

void addRoundedFace(TriangleMesh& mesh, const RoundedBoxShape& shape, const FaceAxes& face) {
  const Eigen::Vector3d half = shape.size_m.cast<double>() / 2.0;
  const double half_right = std::fabs(face.right.cast<double>().dot(half));
  const double half_up = std::fabs(face.up.cast<double>().dot(half));
  const std::vector<double> rights = gridLines(half_right, shape.radius_m, shape.steps);
  const std::vector<double> ups = gridLines(half_up, shape.radius_m, shape.steps);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto row = static_cast<std::uint32_t>(rights.size());
  for (const double up : ups) {
    for (const double right : rights) {
      const Eigen::Vector3d out = face.normal.cast<double>().cwiseProduct(half);
      addRoundedVertex(mesh, shape, out + right * face.right.cast<double>() + up * face.up.cast<double>());
      mesh.texture_coordinates.push_back(Eigen::Vector2d(right + half_right, up + half_up).cast<float>());
    }
  }
  for (std::uint32_t v = 0; v + 1 < ups.size(); ++v) {
    for (std::uint32_t u = 0; u + 1 < row; ++u) {
      const std::uint32_t corner = first + v * row + u;
      mesh.triangles.push_back({corner, corner + 1, corner + row + 1});
      mesh.triangles.push_back({corner, corner + row + 1, corner + row});
    }
  }
}

}  // namespace

TriangleMesh makeBox(const Eigen::Vector3f& size_m, TextureScale scale) {
  return makeBoxBetween({-size_m / 2.0F, size_m / 2.0F}, scale);
}

TriangleMesh makeBoxBetween(const Eigen::AlignedBox3f& bounds_m, TextureScale scale) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      addFace(mesh, bounds_m, faceAxes(axis, side), scale);
    }
  }
  return mesh;
}

TriangleMesh makeCylinder(const CylinderShape& shape, TextureScale scale) {
  const float half_m = shape.length_m / 2.0F;
  const float radius_m = shape.radius_m;
  return makeRevolved(
      {.profile = {{0.0F, -half_m}, {radius_m, -half_m}, {radius_m, half_m}, {0.0F, half_m}}, .segments = shape.segments, .scale = scale});
}

TriangleMesh makeSphere(const SphereShape& shape, TextureScale scale) {
  OIKOS_CHECK(shape.rings >= 2);
  TriangleMesh mesh;
  for (int ring = 0; ring <= shape.rings; ++ring) {
    addRing(mesh, shape, ring);
  }
  for (int ring = 0; ring < shape.rings; ++ring) {
    addBelt(mesh, shape, ring);
  }
  if (scale == TextureScale::kMetres) {
    const auto half_turn_m = static_cast<float>(std::numbers::pi) * shape.radius_m;
    for (Eigen::Vector2f& coordinates : mesh.texture_coordinates) {
      coordinates = coordinates.cwiseProduct(Eigen::Vector2f(2.0F * half_turn_m, half_turn_m));
    }
  }
  return mesh;
}

TriangleMesh makeRoundedBox(const RoundedBoxShape& shape) {
  OIKOS_CHECK(shape.radius_m > 0.0F && 2.0F * shape.radius_m < shape.size_m.minCoeff() && shape.steps >= 1);
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      addRoundedFace(mesh, shape, faceAxes(axis, side));
    }
  }
  return mesh;
}

}  // namespace oikos::model
