// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/model/triangle_mesh.h"
#include "core/render/scene.h"
#include "registration/scan.h"

namespace oikos::registration {

/// One rigid part of a landmark: what is kept or dropped as a whole.
struct LandmarkSurface {
  int landmark = 0;
  std::string part;      ///< its name in the model
  bool is_base = false;  ///< it does not move while the piece stands; a door does
};

/// Furniture that is believed to stand where it was put (S220), each part of it a model of its own in the scene, so that an opened door can
/// be left out and its cupboard kept. Surface i is model i of the scene. Not thread-safe.
class LandmarkScene {
 public:
  /// Returns the landmark's number. Throws as render::Scene::add. `joint_values`: what is believed of doors and drawers.
  int add(const std::string& id, const model::ArticulatedModel& model, const Eigen::Isometry3d& T_map_model,
          const std::vector<double>& joint_values);

  [[nodiscard]] const std::vector<std::string>& ids() const { return ids_; }  ///< by landmark
  [[nodiscard]] const std::vector<LandmarkSurface>& surfaces() const { return surfaces_; }
  [[nodiscard]] const render::Scene& scene() const { return scene_; }
  /// Something that hides what is behind it and is no landmark itself: a wall. It counts in countInView() only.
  void addOccluder(const model::TriangleMesh& mesh_map);

  /// How many of the scan's readings each surface covers from there, with everything shown and behind no occluder (S106, S211).
  [[nodiscard]] std::vector<int> countInView(const Scan& scan, const Eigen::Isometry3d& T_map_camera, int threads) const;

  /// Shows these surfaces and hides the others; one entry a surface.
  void show(const std::vector<char>& shown);

 private:
  render::Scene scene_;
  render::Scene whole_;                ///< all surfaces, always shown, and the occluders
  std::vector<int> surface_of_whole_;  ///< of each model of `whole_`; -1: an occluder
  std::vector<std::string> ids_;
  std::vector<LandmarkSurface> surfaces_;
};

}  // namespace oikos::registration
