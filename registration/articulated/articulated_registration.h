// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "core/model/articulated_model.h"
#include "registration/articulated/articulated_config.h"
#include "registration/articulated/articulated_result.h"
#include "registration/articulated/joint_profile.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/link_layers.h"
#include "registration/articulated/pixel_mixture.h"
#include "registration/articulated/surroundings.h"
#include "registration/scan.h"

namespace oikos::registration {

/// What is known of one image beside its pose.
struct ImageContext {
  double base_sigma_m = 0.0;    ///< how well camera and believed place of the piece agree, in x and in y,
  double base_sigma_deg = 0.0;  ///< and in yaw: standard deviations, in place of the configuration's
  Surroundings surroundings;    ///< of the scan's size; empty: nothing is known of them
};

/// How far doors and drawers of a piece stand open in a depth image (S227-S235). Every value of each joint is compared with the image by
/// rendering, whatever was believed of it; then the base, and the joints down the tree, are solved for, and the values are compared once
/// more. Holds what is needed to render the model, so that one piece of furniture costs little the second time. Not thread-safe.
class ArticulatedRegistration {
 public:
  /// Throws as model::Kinematics and render::Scene::add; ContractViolation if `config` is not valid.
  ArticulatedRegistration(const model::ArticulatedModel& model, const ArticulatedConfig& config);

  /// `believed`: where the piece is thought to stand (deviations: JointSolverConfig), and its joints; these only matter where nothing is
  /// seen of them.
  ArticulatedResult run(const Scan& scan, const Eigen::Isometry3d& T_map_camera, const Standing& believed);
  /// The same with what is known of the image; both deviations must be above 0.
  ArticulatedResult run(const Scan& scan, const Eigen::Isometry3d& T_map_camera, const Standing& believed, const ImageContext& context);

 private:
  JointTree tree_;
  ArticulatedConfig config_;
  PixelMixture mixture_;
  LinkLayers layers_;
  WholeModel whole_;
};

}  // namespace oikos::registration
