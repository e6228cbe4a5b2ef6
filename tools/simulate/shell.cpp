// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/shell.h"

#include <algorithm>
#include <cmath>

namespace oikos::simulate {

namespace {

constexpr double kSkirtingDepth_m = 0.012;
constexpr double kBesideWall_m = 0.25;  // an opening so near a wall goes through it

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Counter-clockwise.
std::vector<Eigen::Vector2d> oriented(std::vector<Eigen::Vector2d> outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    area += cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  if (area < 0.0) {
    std::reverse(outline.begin(), outline.end());
  }
  return outline;
}

bool isInside(const std::array<Eigen::Vector2d, 3>& corner, const Eigen::Vector2d& p) {
  return cross(corner[1] - corner[0], p - corner[0]) >= 0.0 && cross(corner[2] - corner[1], p - corner[1]) >= 0.0 &&
         cross(corner[0] - corner[2], p - corner[2]) >= 0.0;
}

/// Cuts off ears (Meisters, "Polygons Have Ears", 1975): indices of triangles, counter-clockwise.
std::vector<model::TriangleMesh::Triangle> triangulate(const std::vector<Eigen::Vector2d>& outline) {
  std::vector<std::uint32_t> left(outline.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) {
    left[i] = i;
  }
  std::vector<model::TriangleMesh::Triangle> triangles;
  for (std::size_t i = 0, in_vain = 0; left.size() > 3 && in_vain < left.size(); ++i, ++in_vain) {
    const std::size_t here = i % left.size();
    const model::TriangleMesh::Triangle ear = {left[(here + left.size() - 1) % left.size()], left[here], left[(here + 1) % left.size()]};
    const std::array<Eigen::Vector2d, 3> corner = {outline[ear[0]], outline[ear[1]], outline[ear[2]]};
    const bool is_ear =
        cross(corner[1] - corner[0], corner[2] - corner[0]) > 0.0 && std::none_of(left.begin(), left.end(), [&](std::uint32_t other) {
          return std::find(ear.begin(), ear.end(), other) == ear.end() && isInside(corner, outline[other]);
        });
    if (is_ear) {
      triangles.push_back(ear);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(here));
      in_vain = 0;
    }
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

class ShellBuilder {
 public:
  ShellBuilder() {
    mesh.materials.resize(kShellMaterialCount);
    mesh.materials[kFloorMaterial].name = "floor";
    mesh.materials[kCeilingMaterial].name = "ceiling";
    mesh.materials[kWallMaterial].name = "wall";
    mesh.materials[kSkirtingMaterial].name = "skirting";
  }

  void addFlat(const std::vector<Eigen::Vector2d>& outline, double z_m, ShellMaterial material) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Eigen::Vector2d& corner : outline) {
      add({corner.x(), corner.y(), z_m}, corner);
    }
    for (model::TriangleMesh::Triangle triangle : triangulate(outline)) {
      if (material == kCeilingMaterial) {
        std::swap(triangle[1], triangle[2]);
      }
      addTriangle({first + triangle[0], first + triangle[1], first + triangle[2]}, material);
    }
  }

  /// A rectangle that stands on the line from `a` to `b`, with the room on its left.
  struct Upright {
    Eigen::Vector2d a;
    Eigen::Vector2d b;
    double low_m;
    double high_m;
    Eigen::Vector2d texture_m;  ///< of a's foot on the floor
  };
  void addUpright(const Upright& rectangle, ShellMaterial material) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const double begin_m = rectangle.texture_m.x();
    const double end_m = begin_m + (rectangle.b - rectangle.a).norm();
    const double foot_m = rectangle.texture_m.y();
    const auto at = [](const Eigen::Vector2d& p, double z_m) { return Eigen::Vector3d(p.x(), p.y(), z_m); };
    add(at(rectangle.b, rectangle.low_m), {-end_m, foot_m + rectangle.low_m});
    add(at(rectangle.a, rectangle.low_m), {-begin_m, foot_m + rectangle.low_m});
    add(at(rectangle.a, rectangle.high_m), {-begin_m, foot_m + rectangle.high_m});
    add(at(rectangle.b, rectangle.high_m), {-end_m, foot_m + rectangle.high_m});
    addTriangle({first, first + 1, first + 2}, material);
    addTriangle({first, first + 2, first + 3}, material);
  }

  model::TriangleMesh mesh;

 private:
  void add(const Eigen::Vector3d& corner_map, const Eigen::Vector2d& texture) {
    mesh.vertices.push_back(corner_map.cast<float>());
    mesh.texture_coordinates.push_back(texture.cast<float>());
  }
  void addTriangle(const model::TriangleMesh::Triangle& triangle, ShellMaterial material) {
    mesh.triangles.push_back(triangle);
    mesh.triangle_materials.push_back(material);
  }
};

/// An opening of one wall: from where to where along it.
struct Gap {
  double from_m;
  double to_m;
  double height_m;
};

std::vector<Gap> gapsOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const RoomShell& shell) {
  const Eigen::Vector2d direction = (b - a).normalized();
  std::vector<Gap> gaps;
  for (const WallOpening& opening : shell.openings) {
    const auto beside = [&](const Eigen::Vector2d& p) { return std::abs(cross(direction, p - a)); };
    const double first = direction.dot(opening.from_map - a);
    const double second = direction.dot(opening.to_map - a);
    const Gap gap{std::max(0.0, std::min(first, second)), std::min((b - a).norm(), std::max(first, second)), opening.height_m};
    if (std::max(beside(opening.from_map), beside(opening.to_map)) < kBesideWall_m && gap.to_m - gap.from_m > 0.1) {
      gaps.push_back(gap);
    }
  }
  std::sort(gaps.begin(), gaps.end(), [](const Gap& x, const Gap& y) { return x.from_m < y.from_m; });
  return gaps;
}

void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const RoomShell& shell, const Eigen::Vector2d& texture_m,
             ShellBuilder& builder) {
  const Eigen::Vector2d direction = (b - a).normalized();
  const Eigen::Vector2d inwards(-direction.y(), direction.x());
  const auto piece = [&](double from_m, double to_m, double low_m) {
    if (to_m - from_m < 1e-6 || low_m >= shell.height_m) {
      return;
    }
    builder.addUpright({a + from_m * direction, a + to_m * direction, low_m, shell.height_m, texture_m + Eigen::Vector2d(from_m, 0.0)},
                       kWallMaterial);
    if (low_m > 0.0) {
      return;
    }
    const Eigen::Vector2d step = kSkirtingDepth_m * inwards;
    builder.addUpright(
        {a + from_m * direction + step, a + to_m * direction + step, 0.0, shell.skirting_m, texture_m + Eigen::Vector2d(from_m, 0.0)},
        kSkirtingMaterial);
  };
  double done_m = 0.0;
  for (const Gap& gap : gapsOf(a, b, shell)) {
    piece(done_m, gap.from_m, 0.0);
    piece(std::max(done_m, gap.from_m), gap.to_m, gap.height_m);
    done_m = std::max(done_m, gap.to_m);
  }
  piece(done_m, (b - a).norm(), 0.0);
}

}  // namespace

model::TriangleMesh makeThreshold(const WallOpening& opening) {
  constexpr double kHalfDepth_m = 0.08;
  const Eigen::Vector2d along = (opening.to_map - opening.from_map).normalized();
  const Eigen::Vector2d across = kHalfDepth_m * Eigen::Vector2d(-along.y(), along.x());
  ShellBuilder builder;
  builder.addFlat({opening.from_map - across, opening.to_map - across, opening.to_map + across, opening.from_map + across}, 0.002,
                  kFloorMaterial);
  return std::move(builder.mesh);
}

model::TriangleMesh makeShell(const RoomShell& shell) {
  ShellBuilder builder;
  const std::vector<Eigen::Vector2d> outline = oriented(shell.outline_map);
  builder.addFlat(outline, 0.0, kFloorMaterial);
  builder.addFlat(outline, shell.height_m, kCeilingMaterial);
  Eigen::Vector2d texture_m = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& next = outline[(i + 1) % outline.size()];
    const double length_m = (next - outline[i]).norm();
    if (texture_m.x() + length_m > kShellTexture_m) {
      texture_m = {0.0, texture_m.y() + shell.height_m};  // the next row
    }
    addWall(outline[i], next, shell, texture_m, builder);
    texture_m.x() += length_m;
  }
  return std::move(builder.mesh);
}

}  // namespace oikos::simulate
