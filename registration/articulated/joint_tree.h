// SPDX-License-Identifier: Apache-2.0
// A model as the registration of its joints sees it: rigid links, each moved by one joint.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::registration {

/// Parts that move together. Knobs and what is fixed belong to the link that carries them (S235).
struct Link {
  int joint = -1;          ///< index in the model of the joint that moves it; -1: the base
  int parent = -1;         ///< the link that this joint hangs on
  std::vector<int> parts;  ///< indices in the model; the first is the joint's child (of the base: the root), whose frame is the link's
  std::vector<int> chain;  ///< the links whose joints move it, from the root outwards, itself included; empty for the base
};

/// Where a joint is in `map`, given how its parent stands.
struct JointAxis {
  bool is_turn = false;
  Eigen::Vector3d origin_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_map = Eigen::Vector3d::UnitZ();

  /// Of a point that the joint moves: m/rad or m/m.
  [[nodiscard]] Eigen::Vector3d velocityOf(const Eigen::Vector3d& point_map) const {
    return is_turn ? axis_map.cross(point_map - origin_map) : axis_map;
  }
};

/// The links of a model in the order of registration: the base, then parents before children. Immutable, so thread-safe.
class JointTree {
 public:
  /// Throws as model::Kinematics.
  explicit JointTree(model::ArticulatedModel model);

  [[nodiscard]] const model::ArticulatedModel& model() const { return model_; }
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  [[nodiscard]] int linkOf(int part) const { return link_of_[static_cast<std::size_t>(part)]; }
  [[nodiscard]] const model::ModelJoint& jointOf(int link) const;
  /// Whether any joint hangs on another one.
  [[nodiscard]] bool isNested() const;
  /// Whether `link` is `ancestor` or hangs on it, over however many joints.
  [[nodiscard]] bool hangsOn(int link, int ancestor) const;

  /// T_model_part of each part. `joint_values`: one a joint of the model.
  [[nodiscard]] std::vector<Eigen::Isometry3d> partPoses(const std::vector<double>& joint_values) const {
    return kinematics_.solve(joint_values);
  }
  /// By link; that of the base means nothing.
  [[nodiscard]] std::vector<JointAxis> axes(const Eigen::Isometry3d& T_map_model, const std::vector<Eigen::Isometry3d>& T_model_part) const;

 private:
  void grow(int root);

  model::ArticulatedModel model_;
  model::Kinematics kinematics_;
  std::vector<Link> links_;
  std::vector<int> link_of_;
};

}  // namespace oikos::registration
