// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "core/geometry/se3.h"
#include "core/model/articulated_model.h"
#include "registration/articulated/joint_decision.h"
#include "registration/articulated/joint_solver.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/link_layers.h"
#include "registration/articulated/pixel_mixture.h"
#include "registration/scan.h"

namespace oikos::registration {

enum class SolveOrder {
  kPartAfterPart,  ///< the base, then each joint down the tree (S228, S229, S235)
  kTogether,       ///< and then all of them at once
};
constexpr auto enumTable(SolveOrder) {
  return std::to_array<base::EnumName<SolveOrder>>({{SolveOrder::kPartAfterPart, "part after part"}, {SolveOrder::kTogether, "together"}});
}

enum class BaseStatus {
  kNotInView,   ///< nothing of it is before a reading: it is where it was believed to be, as far as the doors do not say more
  kNotThere,    ///< the readings do not fit it: it has been moved farther than can be told, or is another piece
  kRegistered,  ///< S228
};
constexpr auto enumTable(BaseStatus) {
  return std::to_array<base::EnumName<BaseStatus>>(
      {{BaseStatus::kNotInView, "not in view"}, {BaseStatus::kNotThere, "not there"}, {BaseStatus::kRegistered, "registered"}});
}

struct ArticulatedConfig {
  MixtureConfig mixture;
  JointSolverConfig solver;
  JointDecisionConfig decision;
  SolveOrder order = SolveOrder::kTogether;
  double stride_m = 0.03;        ///< how far the outermost point of a part moves from one value to the next that is looked at
  int coarse_thinning = 2;       ///< these are compared in one scan point of so many rows and columns
  double coarse_sigma_m = 0.02;  ///< of surfaces before the base is registered,
  double fine_sigma_m = 0.010;   ///< and after it
  double profile_tempering = 0.1;
  int most_rivals = 3;          ///< local maxima of a joint's profile that are solved for, if they come near the best one,
  double rival_share = 0.5;     ///< which is to say, within this share of its log likelihood
  int min_base_pixels = 20;     ///< of the scan: fewer readings do not tell where the base is, nor that it is not there
  double min_base_share = 0.3;  ///< of the readings of the base and behind it, those of it
  double max_unseen_off =
      3.0;                   ///< deviations that a base of which nothing is seen, and the joint on it, may be from where they are believed
  double unlimited_m = 1.0;  ///< to both sides of the believed value, for a slide without limits
  int threads = 1;           ///< of the renderer

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("mixture", mixture);
    visitor("solver", solver);
    visitor("decision", decision);
    visitor("order", order);
    visitor("stride_m", stride_m);
    visitor("coarse_thinning", coarse_thinning);
    visitor("coarse_sigma_m", coarse_sigma_m);
    visitor("fine_sigma_m", fine_sigma_m);
    visitor("profile_tempering", profile_tempering);
    visitor("most_rivals", most_rivals);
    visitor("rival_share", rival_share);
    visitor("min_base_pixels", min_base_pixels);
    visitor("min_base_share", min_base_share);
    visitor("max_unseen_off", max_unseen_off);
    visitor("unlimited_m", unlimited_m);
    visitor("threads", threads);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// One door, drawer or lid.
struct JointEstimate {
  int joint = 0;     ///< index in the model
  std::string name;  ///< the joint's
  JointStatus status = JointStatus::kNotInView;
  double value = 0.0;       ///< rad or m, within the limits; of a joint that was not found: the best guess, with its variance
  double variance = 0.0;    ///< rad^2 or m^2
  double confidence = 0.0;  ///< that no other value explains the image
  Eigen::Isometry3d T_parent_part = Eigen::Isometry3d::Identity();  ///< of the joint's child (S233)
  Eigen::Isometry3d T_map_part = Eigen::Isometry3d::Identity();
  JointEvidence evidence;
  JointSight sight;
};

struct [[nodiscard]] ArticulatedResult {
  BaseStatus status = BaseStatus::kNotInView;
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();  ///< the base, registered again
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of its right perturbation (m, rad); where nothing is seen: its prior's
  LinkCounts base_counts;
  double rms_m = 0.0;                         ///< of all that agrees, from the surfaces
  std::vector<JointEstimate> joints;          ///< parents before children; knobs and fixed joints have none
  std::vector<double> joint_values;           ///< one a joint of the model
  std::vector<Eigen::Isometry3d> T_map_part;  ///< one a part of the model: children are carried along (S234, S235)

  [[nodiscard]] const JointEstimate* find(const std::string& joint_name) const;
};

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
