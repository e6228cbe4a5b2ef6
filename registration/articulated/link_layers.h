// SPDX-License-Identifier: Apache-2.0
// Links of a model, each to be seen alone: what one joint moves is rendered from a camera that moves the other way, and nothing has to be
// built anew for the next value of the joint.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/render/scene.h"
#include "core/render/view.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/scan_window.h"

namespace oikos::registration {

/// What a window of the image shows.
struct WindowView {
  PixelWindow window;
  render::View view;  ///< depth, normals and parts, of the window's size; nothing in it if the window is empty
};

/// Not thread-safe.
class LinkLayers {
 public:
  LinkLayers(const JointTree& tree, int threads);

  /// Poses the children in each link's branch; with_branches: whether what hangs on a link is seen with it.
  void pose(const std::vector<Eigen::Isometry3d>& T_model_part, bool with_branches);

  /// A link (with its branch) by itself. `camera`: of the whole image.
  [[nodiscard]] WindowView look(int link, const Eigen::Isometry3d& T_camera_link, const camera::PinholeCamera& camera) const;

  /// What the link's own parts take up, in its frame.
  [[nodiscard]] const Eigen::AlignedBox3d& ownBox(int link) const { return layers_[static_cast<std::size_t>(link)].own_box; }
  /// The farthest that a point of the link is from its joint's axis; 1 for one that slides: how far a joint's unit moves it.
  [[nodiscard]] double lever(int link) const { return layers_[static_cast<std::size_t>(link)].lever; }

 private:
  struct Layer {
    render::Scene scene;
    std::vector<int> parts;  ///< of the model, by number in the scene
    Eigen::AlignedBox3d own_box;
    Eigen::AlignedBox3d box;  ///< with what is shown of the branch
    double lever = 1.0;
  };
  void add(int link);

  const JointTree& tree_;
  int threads_;
  std::vector<Layer> layers_;
};

/// All of the model in one scene, each part where it is said to be.
class WholeModel {
 public:
  WholeModel(const JointTree& tree, int threads);

  void place(const std::vector<Eigen::Isometry3d>& T_map_part);
  /// `view.part` is -1 or the index of a part in the model.
  [[nodiscard]] render::View look(const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera) const;

 private:
  int threads_;
  render::Scene scene_;
  std::vector<int> parts_;  ///< of the model, by number in the scene
};

}  // namespace oikos::registration
