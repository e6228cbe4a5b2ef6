// SPDX-License-Identifier: Apache-2.0
// Knobs as meshes, put together from outlines. Frame `knob`: z away from the panel, the axis at x = y = 0, the panel at z = 0, the mark
// towards +x.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "core/model/triangle_mesh.h"
#include "recognition/knobs/training/random.h"

namespace oikos::recognition {

/// Corners counter-clockwise seen from +z, around a point that sees all of them.
using Outline = std::vector<Eigen::Vector2f>;

[[nodiscard]] Outline circleOutline(float radius_m, int corners = 48);
/// By the direction of each corner (rad).
[[nodiscard]] Outline polarOutline(const std::function<float(float)>& radius_m, int corners = 72);
/// A rectangle from `from_m` to `to_m` along x, `width_m` wide, its ends round if `is_round`.
struct BarOutline {
  float from_m = 0.0F;
  float to_m = 0.01F;
  float width_m = 0.002F;
  bool is_round = false;
};
[[nodiscard]] Outline barOutline(const BarOutline& bar);
[[nodiscard]] Outline moved(Outline outline, const Eigen::Vector2f& by_m);

/// Materials of every knob; what has only two shows no `kSkirt`.
enum KnobMaterial : std::uint32_t { kBody = 0, kMark = 1, kSkirt = 2 };

/// The rim of a slice: an outline, scaled about the axis.
struct Rim {
  float z_m = 0.0F;
  float scale = 1.0F;
};

class KnobSolid {
 public:
  /// The wall between two rims of one outline; corners of less than 40 degrees are shaded smoothly.
  void addWall(const Outline& outline, const Rim& low, const Rim& high, KnobMaterial material);
  /// A flat top.
  void addTop(const Outline& outline, const Rim& rim, KnobMaterial material);
  /// Both.
  void addPrism(const Outline& outline, const Rim& low, const Rim& high, KnobMaterial material);
  /// With a bevel of `bevel_m` at its upper edge.
  void addBevelled(const Outline& outline, const Rim& low, const Rim& high, float bevel_m, KnobMaterial material);

  /// With three materials, whose looks are still to be set.
  [[nodiscard]] model::TriangleMesh build() const { return mesh_knob_; }

 private:
  void addQuad(const std::array<Eigen::Vector3f, 4>& corners, const std::array<Eigen::Vector3f, 4>& normals, KnobMaterial material);
  void addTriangle(const std::array<Eigen::Vector3f, 3>& corners, const std::array<Eigen::Vector3f, 3>& normals, KnobMaterial material);

  model::TriangleMesh mesh_knob_;
};

/// What a knob of a family is made to; the rest is chance.
struct KnobSize {
  float radius_m = 0.02F;
  float height_m = 0.02F;
  float mark_scale = 1.0F;  ///< of the breadth of its mark
};
using KnobMaker = std::function<model::TriangleMesh(const KnobSize&, Random&)>;

/// The families that the detector is trained on.
[[nodiscard]] const std::vector<KnobMaker>& trainingKnobs();

}  // namespace oikos::recognition
