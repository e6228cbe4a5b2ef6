// SPDX-License-Identifier: Apache-2.0
// Posed models, ready to be looked at.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::render {

class EmbreeScene;
class TexturePyramid;
struct SurfaceTriangle;

/// A material, ready to be looked at.
struct SurfaceLook {
  Eigen::Array3f color_rgb = Eigen::Array3f::Zero();  ///< linear
  float gloss = 0.0F;
  std::shared_ptr<const TexturePyramid> texture;  ///< null: none
};

/// One part of one model, where it is now.
struct ScenePart {
  int model = 0;  ///< its number in the scene
  int part = 0;   ///< index in its ArticulatedModel
  std::shared_ptr<const model::TriangleMesh> mesh_part;
  std::shared_ptr<const std::vector<SurfaceTriangle>> surfaces;  ///< one a triangle
  std::vector<SurfaceLook> looks;                                ///< one a material, at least one
  Eigen::Isometry3d T_map_part = Eigen::Isometry3d::Identity();
};

/// A set of articulated models with their poses and joint values. Models that share a mesh share its search tree, and a part that moves
/// costs no more than the tree over the parts. Changing is not thread-safe; between commit() and the next change a scene can be
/// looked at from any number of threads.
class Scene {
 public:
  /// Throws Error{kIo} if the ray tracer cannot start: it needs a processor with AVX2.
  Scene();
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// Returns the model's number: 0, 1, 2, … Throws Error{kInput} for what Kinematics or validate(mesh) objects to.
  int add(const model::ArticulatedModel& model, const Eigen::Isometry3d& T_map_model, const std::vector<double>& joint_values);
  /// A mesh that nothing moves in.
  int add(std::shared_ptr<const model::TriangleMesh> mesh_model, const Eigen::Isometry3d& T_map_model);

  /// `joint_values`: as of Kinematics::solve.
  void move(int model, const Eigen::Isometry3d& T_map_model, const std::vector<double>& joint_values);
  /// A model that is not shown is not there.
  void show(int model, bool is_shown);
  /// Makes what changed since the last call visible to renderers.
  void commit();

  [[nodiscard]] int modelCount() const;
  /// All parts that have a mesh; what a rendered part image refers to.
  [[nodiscard]] const std::vector<ScenePart>& parts() const;
  /// For the renderer.
  [[nodiscard]] const EmbreeScene& embree() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oikos::render
