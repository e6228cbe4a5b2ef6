// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/training/knob_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oikos::recognition {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kSmoothCosine = 0.766F;  // of 40 degrees

Eigen::Vector3f lifted(const Eigen::Vector2f& point, const Rim& rim) {
  return {point.x() * rim.scale, point.y() * rim.scale, rim.z_m};
}

/// Away from the solid on the wall over an edge of the outline.
Eigen::Vector3f wallNormal(const Eigen::Vector2f& from, const Eigen::Vector2f& to, const Rim& low, const Rim& high) {
  const Eigen::Vector3f along = lifted(to, low) - lifted(from, low);
  const Eigen::Vector3f up = lifted(from, high) - lifted(from, low);
  return along.cross(up).normalized();
}

Eigen::Vector3f smoothed(const Eigen::Vector3f& own, const Eigen::Vector3f& neighbour) {
  return own.dot(neighbour) < kSmoothCosine ? own : Eigen::Vector3f((own + neighbour).normalized());
}

}  // namespace

Outline circleOutline(float radius_m, int corners) {
  return polarOutline([radius_m](float) { return radius_m; }, corners);
}

Outline polarOutline(const std::function<float(float)>& radius_m, int corners) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const float angle = 2.0F * kPi * static_cast<float>(i) / static_cast<float>(corners);
    outline.emplace_back(radius_m(angle) * std::cos(angle), radius_m(angle) * std::sin(angle));
  }
  return outline;
}

Outline barOutline(const BarOutline& bar) {
  const float half = bar.width_m / 2.0F;
  if (!bar.is_round) {
    return {{bar.from_m, -half}, {bar.to_m, -half}, {bar.to_m, half}, {bar.from_m, half}};
  }
  Outline outline;
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps; ++i) {
    const float angle = kPi * (static_cast<float>(i) / kSteps - 0.5F);
    outline.emplace_back(bar.to_m - half + half * std::cos(angle), half * std::sin(angle));
  }
  for (int i = 0; i <= kSteps; ++i) {
    const float angle = kPi * (static_cast<float>(i) / kSteps + 0.5F);
    outline.emplace_back(bar.from_m + half + half * std::cos(angle), half * std::sin(angle));
  }
  return outline;
}

Outline moved(Outline outline, const Eigen::Vector2f& by_m) {
  for (Eigen::Vector2f& corner : outline) {
    corner += by_m;
  }
  return outline;
}

void KnobSolid::addTriangle(const std::array<Eigen::Vector3f, 3>& corners, const std::array<Eigen::Vector3f, 3>& normals,
                            KnobMaterial material) {
  if (mesh_knob_.materials.empty()) {
    mesh_knob_.materials.resize(3);
  }
  const auto first = static_cast<std::uint32_t>(mesh_knob_.vertices.size());
  mesh_knob_.vertices.insert(mesh_knob_.vertices.end(), corners.begin(), corners.end());
  mesh_knob_.normals.insert(mesh_knob_.normals.end(), normals.begin(), normals.end());
  mesh_knob_.triangles.push_back({first, first + 1, first + 2});
  mesh_knob_.triangle_materials.push_back(material);
  for (const Eigen::Vector3f& corner : corners) {
    mesh_knob_.texture_coordinates.emplace_back(corner.x() / 0.05F, (corner.y() + corner.z()) / 0.05F);
  }
}

void KnobSolid::addQuad(const std::array<Eigen::Vector3f, 4>& corners, const std::array<Eigen::Vector3f, 4>& normals,
                        KnobMaterial material) {
  addTriangle({corners[0], corners[1], corners[2]}, {normals[0], normals[1], normals[2]}, material);
  addTriangle({corners[0], corners[2], corners[3]}, {normals[0], normals[2], normals[3]}, material);
}

void KnobSolid::addWall(const Outline& outline, const Rim& low, const Rim& high, KnobMaterial material) {
  const std::size_t count = outline.size();
  const auto normalOf = [&](std::size_t edge) { return wallNormal(outline[edge % count], outline[(edge + 1) % count], low, high); };
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2f& from = outline[i];
    const Eigen::Vector2f& to = outline[(i + 1) % count];
    const Eigen::Vector3f own = normalOf(i);
    const Eigen::Vector3f at_from = smoothed(own, normalOf(i + count - 1));
    const Eigen::Vector3f at_to = smoothed(own, normalOf(i + 1));
    addQuad({lifted(from, low), lifted(to, low), lifted(to, high), lifted(from, high)}, {at_from, at_to, at_to, at_from}, material);
  }
}

void KnobSolid::addTop(const Outline& outline, const Rim& rim, KnobMaterial material) {
  Eigen::Vector2f middle = Eigen::Vector2f::Zero();
  for (const Eigen::Vector2f& corner : outline) {
    middle += corner / static_cast<float>(outline.size());
  }
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    addTriangle({lifted(middle, rim), lifted(outline[i], rim), lifted(outline[(i + 1) % outline.size()], rim)}, {up, up, up}, material);
  }
}

void KnobSolid::addPrism(const Outline& outline, const Rim& low, const Rim& high, KnobMaterial material) {
  addWall(outline, low, high, material);
  addTop(outline, high, material);
}

void KnobSolid::addBevelled(const Outline& outline, const Rim& low, const Rim& high, float bevel_m, KnobMaterial material) {
  float reach_m = 1e-6F;
  for (const Eigen::Vector2f& corner : outline) {
    reach_m = std::max(reach_m, corner.norm());
  }
  const Rim shoulder{high.z_m - bevel_m, high.scale};
  const Rim top{high.z_m, high.scale * (1.0F - bevel_m / reach_m)};
  addWall(outline, low, shoulder, material);
  addWall(outline, shoulder, top, material);
  addTop(outline, top, material);
}

}  // namespace oikos::recognition
