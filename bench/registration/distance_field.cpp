// SPDX-License-Identifier: Apache-2.0
#include "bench/registration/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oikos::bench {

namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr int kSmallBlock = 4;           ///< voxels along an edge
constexpr float kBeside_voxels = 1.75F;  ///< so far beside its triangles a plane goes on: a cell at the edge has all of its corners,
constexpr float kBesideSlope = 0.2F;     ///< and the farther the more, as round surfaces ask for

Eigen::Vector3f nearestOnEdge(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& p) {
  const Eigen::Vector3f along = b - a;
  return a + std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0F, 1.0F) * along;
}

/// Within the triangle the foot of the perpendicular, else the nearest point of its edges.
Eigen::Vector3f nearestOn(const FieldTriangle& triangle, const Eigen::Vector3f& p) {
  const auto& [a, b, c] = triangle.corners;
  const bool is_within = (b - a).cross(p - a).dot(triangle.normal) >= 0.0F && (c - b).cross(p - b).dot(triangle.normal) >= 0.0F &&
                         (a - c).cross(p - c).dot(triangle.normal) >= 0.0F;
  if (is_within) {
    return p - triangle.normal.dot(p - a) * triangle.normal;
  }
  Eigen::Vector3f nearest = nearestOnEdge(a, b, p);
  for (const Eigen::Vector3f& other : {nearestOnEdge(b, c, p), nearestOnEdge(c, a, p)}) {
    nearest = (other - p).squaredNorm() < (nearest - p).squaredNorm() ? other : nearest;
  }
  return nearest;
}

}  // namespace

std::vector<FieldTriangle> trianglesOf(const model::TriangleMesh& mesh_part) {
  std::vector<FieldTriangle> triangles;
  for (std::size_t i = 0; i < mesh_part.triangles.size(); ++i) {
    const Eigen::Vector3d across = mesh_part.areaNormal(i);
    if (across.norm() > 1e-10) {
      const auto& corners = mesh_part.triangles[i];
      triangles.push_back({{mesh_part.vertices[corners[0]], mesh_part.vertices[corners[1]], mesh_part.vertices[corners[2]]},
                           across.normalized().cast<float>()});
    }
  }
  return triangles;
}

DistanceField::DistanceField(const std::vector<FieldTriangle>& triangles, std::size_t axis, const FieldConfig& config)
    : per_voxel_(1.0F / static_cast<float>(config.voxel_m)) {
  if (triangles.empty()) {
    return;
  }
  Eigen::AlignedBox3f box;
  std::vector<const FieldTriangle*> candidates;
  for (const FieldTriangle& triangle : triangles) {
    candidates.push_back(&triangle);
    for (const Eigen::Vector3f& corner : triangle.corners) {
      box.extend(corner);
    }
  }
  Eigen::Vector3f margin_m = Eigen::Vector3f::Constant(static_cast<float>(2.0 * config.voxel_m));
  margin_m[static_cast<Eigen::Index>(axis)] = static_cast<float>(config.margin_m);
  origin_part_ = box.min() - margin_m;
  size_ = ((box.sizes() + 2.0F * margin_m).array() * per_voxel_).ceil().cast<int>() + 1;
  values_m_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(size_.z()),
                   kNothing);
  fill({Eigen::Array3i::Zero(), size_}, candidates);
}

Eigen::Vector3f DistanceField::pointOf(const Eigen::Array3i& index) const {
  return origin_part_ + index.cast<float>().matrix() / per_voxel_;
}

std::size_t DistanceField::placeOf(const Eigen::Array3i& index) const {
  return static_cast<std::size_t>(index.x()) +
         static_cast<std::size_t>(size_.x()) *
             (static_cast<std::size_t>(index.y()) + static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(index.z()));
}

/// A triangle farther from a block's middle than the nearest one by more than the block's width is nearest to none of its points.
void DistanceField::fill(const Block& block, const std::vector<const FieldTriangle*>& candidates) {
  const Eigen::Vector3f middle = 0.5F * (pointOf(block.least) + pointOf(block.end - 1));
  const float radius_m = 0.5F * (pointOf(block.end - 1) - pointOf(block.least)).norm();
  std::vector<float> distances_m;
  float least_m = std::numeric_limits<float>::max();
  for (const FieldTriangle* triangle : candidates) {
    distances_m.push_back((nearestOn(*triangle, middle) - middle).norm());
    least_m = std::min(least_m, distances_m.back());
  }
  std::vector<const FieldTriangle*> near;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (distances_m[i] <= least_m + 2.0F * radius_m + 1e-4F) {
      near.push_back(candidates[i]);
    }
  }
  int longest = 0;
  const int width = (block.end - block.least).maxCoeff(&longest);
  if (width > kSmallBlock) {
    Block low = block;
    Block high = block;
    low.end[longest] = high.least[longest] = block.least[longest] + width / 2;
    fill(low, near);
    fill(high, near);
    return;
  }
  Eigen::Array3i index;
  for (index.z() = block.least.z(); index.z() < block.end.z(); ++index.z()) {
    for (index.y() = block.least.y(); index.y() < block.end.y(); ++index.y()) {
      for (index.x() = block.least.x(); index.x() < block.end.x(); ++index.x()) {
        values_m_[placeOf(index)] = valueAt(pointOf(index), near);
      }
    }
  }
}

/// Where two triangles meet both are nearest: the one that the point is less beside counts.
float DistanceField::valueAt(const Eigen::Vector3f& point, const std::vector<const FieldTriangle*>& candidates) const {
  constexpr float kAlike_m = 1e-5F;
  float least_m = std::numeric_limits<float>::max();
  float before_m = 0.0F;
  for (const FieldTriangle* triangle : candidates) {
    const Eigen::Vector3f from = point - nearestOn(*triangle, point);
    const float distance_m = from.norm();
    const float height_m = triangle->normal.dot(from);
    if (distance_m < least_m - kAlike_m || (distance_m < least_m + kAlike_m && std::abs(height_m) > std::abs(before_m))) {
      before_m = height_m;
      least_m = std::min(least_m, distance_m);
    }
  }
  const float beside_m = std::sqrt(std::max(0.0F, least_m * least_m - before_m * before_m));
  return beside_m < kBeside_voxels / per_voxel_ + kBesideSlope * std::abs(before_m) ? before_m : kNothing;
}

DistanceField::Sample DistanceField::at(const Eigen::Vector3f& point_part) const {
  const Eigen::Array3f place = (point_part - origin_part_).array() * per_voxel_;
  const Eigen::Array3i cell = place.floor().cast<int>();
  if ((cell < 0).any() || (cell + 1 >= size_).any()) {
    return {kNothing};
  }
  const Eigen::Array3f t = place - cell.cast<float>();
  const float* const v = values_m_.data() + placeOf(cell);
  const std::ptrdiff_t dy = size_.x();
  const std::ptrdiff_t dz = dy * size_.y();
  const float x00 = v[0] + t.x() * (v[1] - v[0]);
  const float x10 = v[dy] + t.x() * (v[dy + 1] - v[dy]);
  const float x01 = v[dz] + t.x() * (v[dz + 1] - v[dz]);
  const float x11 = v[dy + dz] + t.x() * (v[dy + dz + 1] - v[dy + dz]);
  const float low = x00 + t.y() * (x10 - x00);
  const float high = x01 + t.y() * (x11 - x01);
  const float step_low = (1.0F - t.y()) * (v[1] - v[0]) + t.y() * (v[dy + 1] - v[dy]);
  const float step_high = (1.0F - t.y()) * (v[dz + 1] - v[dz]) + t.y() * (v[dy + dz + 1] - v[dy + dz]);
  const Eigen::Vector3f step(step_low + t.z() * (step_high - step_low), (1.0F - t.z()) * (x10 - x00) + t.z() * (x11 - x01), high - low);
  return {low + t.z() * (high - low), step * per_voxel_};
}

}  // namespace oikos::bench
