// SPDX-License-Identifier: Apache-2.0
#include "core/model/revolved.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"

namespace oikos::model {

namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
const double kSmoothCosine = std::cos(std::numbers::pi / 4.0);
const double kFlatCosine = std::cos(25.0 / 180.0 * std::numbers::pi);

/// The surface between two neighbouring points of the profile. In (radius, z).
struct Band {
  ProfilePoint from;
  ProfilePoint to;
  Eigen::Vector2d normal;
  Eigen::Vector2d normal_from;  ///< at its two ends, shared with a smooth neighbour
  Eigen::Vector2d normal_to;
  double length_m;
  double v_from = 0.0;
  double v_to = 0.0;
  double turn_u = 1.0;  ///< texture units once around

  [[nodiscard]] bool flat() const { return std::fabs(normal.y()) > kFlatCosine; }
};

Band makeBand(const ProfilePoint& from, const ProfilePoint& to) {
  const Eigen::Vector2d along(static_cast<double>(to.radius_m) - from.radius_m, static_cast<double>(to.z_m) - from.z_m);
  OIKOS_CHECK(along.norm() > 0.0 && from.radius_m >= 0.0F && to.radius_m >= 0.0F);
  const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
  return {.from = from, .to = to, .normal = normal, .normal_from = normal, .normal_to = normal, .length_m = along.norm()};
}

void smoothBetween(Band& before, Band& after) {
  if (before.normal.dot(after.normal) > kSmoothCosine) {
    before.normal_to = (before.normal + after.normal).normalized();
    after.normal_from = before.normal_to;
  }
}

std::vector<Band> makeBands(const std::vector<ProfilePoint>& profile) {
  OIKOS_CHECK(profile.size() >= 3);
  std::vector<Band> bands;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    bands.push_back(makeBand(profile[i], profile[i + 1]));
  }
  for (std::size_t i = 0; i + 1 < bands.size(); ++i) {
    smoothBetween(bands[i], bands[i + 1]);
  }
  const bool is_loop = profile.front().radius_m == profile.back().radius_m && profile.front().z_m == profile.back().z_m;
  OIKOS_CHECK(is_loop || (profile.front().radius_m == 0.0F && profile.back().radius_m == 0.0F));
  if (is_loop) {
    smoothBetween(bands.back(), bands.front());
  }
  return bands;
}

/// Neighbours of one material that all stand upright, or all lie flat, share one image.
std::size_t runEnd(const std::vector<Band>& bands, std::size_t begin) {
  std::size_t end = begin + 1;
  const auto upwards = [&](std::size_t i) { return bands[i].normal.x() >= 0.0; };
  while (end < bands.size() && bands[end].from.material == bands[begin].from.material && bands[end].flat() == bands[begin].flat() &&
         upwards(end) == upwards(begin)) {
    ++end;
  }
  return end;
}

void measureRun(std::vector<Band>& bands, std::size_t begin, std::size_t end, TextureScale scale) {
  double length_m = 0.0;
  double radius_m = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    length_m += bands[i].length_m;
    radius_m = std::max({radius_m, static_cast<double>(bands[i].from.radius_m), static_cast<double>(bands[i].to.radius_m)});
  }
  const double unit_m = scale == TextureScale::kMetres ? 1.0 : length_m;
  double reached_m = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    Band& band = bands[i];
    const bool inner = band.normal.x() < 0.0;  // leads down: measure from its lower end
    band.v_from = (inner ? length_m - reached_m : reached_m) / unit_m;
    reached_m += band.length_m;
    band.v_to = (inner ? length_m - reached_m : reached_m) / unit_m;
    band.turn_u = band.flat() ? radius_m : (scale == TextureScale::kMetres ? kTurn_rad * radius_m : 1.0);
  }
}

struct RingPlace {
  ProfilePoint point;
  Eigen::Vector2d normal;
  double v;
};

Eigen::Vector2f textureAt(const Band& band, const RingPlace& ring, const Eigen::Vector2d& direction, double turn, TextureScale scale) {
  if (!band.flat()) {
    return Eigen::Vector2d(turn * band.turn_u, ring.v).cast<float>();
  }
  // From above +y is to the right and -x up; from below +y is to the right and +x up.
  const double side = band.normal.y() > 0.0 ? -1.0 : 1.0;
  const Eigen::Vector2d place = Eigen::Vector2d(direction.y(), side * direction.x()) * static_cast<double>(ring.point.radius_m);
  const double unit_m = scale == TextureScale::kMetres ? 1.0 : 2.0 * band.turn_u;
  return ((place.array() + band.turn_u) / unit_m).matrix().cast<float>();
}

void addRing(TriangleMesh& mesh, const Band& band, const RingPlace& ring, const RevolvedShape& shape) {
  for (int i = 0; i <= shape.segments; ++i) {
    const double turn = static_cast<double>(i) / shape.segments;
    const double angle_rad = kTurn_rad * (static_cast<double>(i % shape.segments) / shape.segments - 0.5);
    const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Vector2d place = direction * static_cast<double>(ring.point.radius_m);
    mesh.vertices.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()), ring.point.z_m);
    const Eigen::Vector2d level = direction * ring.normal.x();
    mesh.normals.push_back(Eigen::Vector3d(level.x(), level.y(), ring.normal.y()).cast<float>());
    mesh.texture_coordinates.push_back(textureAt(band, ring, direction, turn, shape.scale));
  }
}

void addBand(TriangleMesh& mesh, const Band& band, const RevolvedShape& shape) {
  const auto from = static_cast<std::uint32_t>(mesh.vertices.size());
  addRing(mesh, band, {band.from, band.normal_from, band.v_from}, shape);
  const auto to = static_cast<std::uint32_t>(mesh.vertices.size());
  addRing(mesh, band, {band.to, band.normal_to, band.v_to}, shape);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(shape.segments); ++i) {
    if (band.from.radius_m > 0.0F) {
      mesh.triangles.push_back({from + i, from + i + 1, to + i + 1});
    }
    if (band.to.radius_m > 0.0F) {
      mesh.triangles.push_back({from + i, to + i + 1, to + i});
    }
  }
  mesh.triangle_materials.resize(mesh.triangles.size(), static_cast<std::uint32_t>(band.from.material));
}

Eigen::Vector3d onArc(const BentRodShape& shape, int step) {
  const double angle_rad = shape.from_rad + (static_cast<double>(shape.to_rad) - shape.from_rad) * step / shape.segments;
  return {std::cos(angle_rad), 0.0, std::sin(angle_rad)};
}

void addRodRing(TriangleMesh& mesh, const BentRodShape& shape, int step) {
  const Eigen::Vector3d out = onArc(shape, step);
  const double along_m = (static_cast<double>(shape.to_rad) - shape.from_rad) * shape.arc_radius_m * step / shape.segments;
  for (int i = 0; i <= shape.sides; ++i) {
    const double angle_rad = kTurn_rad * (i % shape.sides) / shape.sides;
    const Eigen::Vector3d normal = std::cos(angle_rad) * out + std::sin(angle_rad) * Eigen::Vector3d::UnitY();
    const Eigen::Vector3d centre = out * static_cast<double>(shape.arc_radius_m);
    mesh.vertices.push_back((centre + normal * static_cast<double>(shape.rod_radius_m)).cast<float>());
    mesh.normals.push_back(normal.cast<float>());
    const double around_m = kTurn_rad * shape.rod_radius_m * i / shape.sides;
    mesh.texture_coordinates.push_back(Eigen::Vector2d(along_m, around_m).cast<float>());
  }
}

/// `side` is 1 at the far end of the arc, -1 at its beginning.
void addRodEnd(TriangleMesh& mesh, const BentRodShape& shape, int step, double side) {
  const Eigen::Vector3d out = onArc(shape, step);
  const Eigen::Vector3f normal = (Eigen::Vector3d(-out.z(), 0.0, out.x()) * side).cast<float>();
  const auto ring = static_cast<std::uint32_t>(step * (shape.sides + 1));
  const auto centre = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back((out * static_cast<double>(shape.arc_radius_m)).cast<float>());
  for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(shape.sides); ++i) {
    mesh.vertices.push_back(mesh.vertices[ring + i]);
  }
  mesh.normals.resize(mesh.vertices.size(), normal);
  mesh.texture_coordinates.resize(mesh.vertices.size(), Eigen::Vector2f::Zero());
  for (std::uint32_t i = 1; i <= static_cast<std::uint32_t>(shape.sides); ++i) {
    mesh.triangles.push_back(side > 0.0 ? TriangleMesh::Triangle{centre, centre + i, centre + i + 1}
                                        : TriangleMesh::Triangle{centre, centre + i + 1, centre + i});
  }
}

}  // namespace

TriangleMesh makeRevolved(const RevolvedShape& shape) {
  OIKOS_CHECK(shape.segments >= 3);
  std::vector<Band> bands = makeBands(shape.profile);
  for (std::size_t begin = 0; begin < bands.size();) {
    const std::size_t end = runEnd(bands, begin);
    measureRun(bands, begin, end, shape.scale);
    begin = end;
  }
  TriangleMesh mesh;
  for (const Band& band : bands) {
    addBand(mesh, band, shape);
  }
  const bool one_material = std::all_of(bands.begin(), bands.end(), [](const Band& band) { return band.from.material == 0; });
  if (one_material) {
    mesh.triangle_materials.clear();
  } else {
    mesh.materials.resize(1 + *std::max_element(mesh.triangle_materials.begin(), mesh.triangle_materials.end()));
  }
  return mesh;
}

TriangleMesh makeTaperedCylinder(const TaperedCylinderShape& shape, TextureScale scale) {
  const float bottom_m = shape.bottom_radius_m;
  const float top_m = shape.top_radius_m;
  return makeRevolved({.profile = {{0.0F, 0.0F, 1}, {bottom_m, 0.0F, 0}, {top_m, shape.height_m, 1}, {0.0F, shape.height_m, 0}},
                       .segments = shape.segments,
                       .scale = scale});
}

TriangleMesh makeTube(const TubeShape& shape, TextureScale scale) {
  const float bottom_m = shape.bottom_radius_m;
  const float top_m = shape.top_radius_m;
  const float wall_m = shape.wall_m;
  return makeRevolved(
      {.profile =
           {{bottom_m, 0.0F}, {top_m, shape.height_m}, {top_m - wall_m, shape.height_m}, {bottom_m - wall_m, 0.0F}, {bottom_m, 0.0F}},
       .segments = shape.segments,
       .scale = scale});
}

TriangleMesh makeBentRod(const BentRodShape& shape) {
  OIKOS_CHECK(shape.segments >= 1 && shape.sides >= 3 && shape.rod_radius_m < shape.arc_radius_m && shape.from_rad < shape.to_rad);
  TriangleMesh mesh;
  for (int step = 0; step <= shape.segments; ++step) {
    addRodRing(mesh, shape, step);
  }
  const auto row = static_cast<std::uint32_t>(shape.sides + 1);
  for (std::uint32_t step = 0; step < static_cast<std::uint32_t>(shape.segments); ++step) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t corner = step * row + i;
      mesh.triangles.push_back({corner, corner + 1, corner + row + 1});
      mesh.triangles.push_back({corner, corner + row + 1, corner + row});
    }
  }
  addRodEnd(mesh, shape, shape.segments, 1.0);
  addRodEnd(mesh, shape, 0, -1.0);
  return mesh;
}

}  // namespace oikos::model
