// SPDX-License-Identifier: Apache-2.0
// How far a point is from a surface, looked up instead of searched for.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::bench {

struct FieldConfig {
  double voxel_m = 0.015;
  double margin_m = 0.35;  ///< the grid goes so far before and behind the surface
};

/// A triangle with its unit normal, in the part's frame.
struct FieldTriangle {
  std::array<Eigen::Vector3f, 3> corners;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// Triangles with an area; counter-clockwise seen from outside.
[[nodiscard]] std::vector<FieldTriangle> trianglesOf(const model::TriangleMesh& mesh_part);

/// On a grid: the signed distance (m, positive in front) from the plane of the nearest of some triangles that face about the same way
/// (Schmidt, Newcombe & Fox, "DART", RSS 2014, whose distances are from the nearest point of a closed surface). Beside the triangles, by
/// more than rounding them to the grid asks for, nothing is defined. Immutable, so thread-safe.
class DistanceField {
 public:
  struct Sample {
    float distance_m = 0.0F;                             ///< NaN: off the grid, or nothing is defined there
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();  ///< 1 long where one surface is near
  };

  DistanceField() = default;  ///< of no triangle
  /// `axis`: of the part, along which the triangles face more or less. Corners and samples are in the part's frame.
  DistanceField(const std::vector<FieldTriangle>& triangles, std::size_t axis, const FieldConfig& config);

  /// Trilinear, with the gradient of what is interpolated.
  [[nodiscard]] Sample at(const Eigen::Vector3f& point_part) const;
  [[nodiscard]] std::size_t bytes() const { return values_m_.size() * sizeof(float); }

 private:
  struct Block {  ///< of the grid's points
    Eigen::Array3i least;
    Eigen::Array3i end;
  };
  void fill(const Block& block, const std::vector<const FieldTriangle*>& candidates);
  [[nodiscard]] float valueAt(const Eigen::Vector3f& point, const std::vector<const FieldTriangle*>& candidates) const;
  [[nodiscard]] Eigen::Vector3f pointOf(const Eigen::Array3i& index) const;
  [[nodiscard]] std::size_t placeOf(const Eigen::Array3i& index) const;

  Eigen::Vector3f origin_part_ = Eigen::Vector3f::Zero();
  float per_voxel_ = 0.0F;
  Eigen::Array3i size_ = Eigen::Array3i::Zero();
  std::vector<float> values_m_;  ///< x runs fastest
};

}  // namespace oikos::bench
