// SPDX-License-Identifier: Apache-2.0
// Furniture that moves: rigid parts in a tree of joints, with what a hand takes hold of.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/handle_kind.h"
#include "core/model/triangle_mesh.h"

namespace oikos::model {

struct ModelPart {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh_part;  ///< null: nothing to see. Models that are copied share it.
};

enum class MotionType { kFixed, kRevolute, kPrismatic };

/// T_parent_child = T_parent_joint * motion about or along the axis by the joint's value (rad or m).
struct ModelJoint {
  std::string name;
  MotionType type = MotionType::kFixed;
  int parent = 0;  ///< index of a part
  int child = 0;   ///< index of a part
  Eigen::Isometry3d T_parent_joint = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis_joint = Eigen::Vector3d::UnitZ();  ///< length 1
  double lower = 0.0;                                     ///< rad or m; infinite: no limit
  double upper = 0.0;
};

/// Its frame lies in the middle of the grip, x away from the face, z along the grip.
struct ModelHandle {
  std::string name;
  int part = 0;
  Eigen::Isometry3d T_part_handle = Eigen::Isometry3d::Identity();
  std::optional<double> length_m;  ///< along the grip; of a knob: its diameter
  HandleKind kind = HandleKind::kBar;
};

struct ModelKnobState {
  std::string name;
  double angle_rad = 0.0;
};

struct ModelKnob {
  std::string name;
  int part = 0;
  Eigen::Isometry3d T_part_knob = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis_knob = Eigen::Vector3d::UnitZ();  ///< length 1
  std::vector<ModelKnobState> states;
};

/// A plain value. The root is the one part that no joint has as its child; its frame is the model's.
struct ArticulatedModel {
  std::string name;
  std::vector<ModelPart> parts;
  std::vector<ModelJoint> joints;
  std::vector<ModelHandle> handles;
  std::vector<ModelKnob> knobs;
};

/// T_joint_child at a value.
[[nodiscard]] Eigen::Isometry3d jointMotion(const ModelJoint& joint, double value);

/// Where the parts are, joint by joint. Immutable, so thread-safe.
class Kinematics {
 public:
  /// Throws Error{kInput} with the model's name for a model that is no tree with one root, an axis that is not of length 1 (to 1e-6),
  /// limits in the wrong order, a frame that is not a rigid motion, or an index or mesh that is wrong.
  explicit Kinematics(const ArticulatedModel& model);

  /// T_model_part of each part, in O(parts). `joint_values`: one a joint (rad or m; those of fixed joints are ignored), not held to the
  /// limits: what was measured may lie a little outside.
  [[nodiscard]] std::vector<Eigen::Isometry3d> solve(const std::vector<double>& joint_values) const;
  [[nodiscard]] int root() const { return root_; }
  [[nodiscard]] int jointCount() const { return static_cast<int>(joints_in_order_.size()); }

 private:
  struct Step {
    int index;  ///< of the joint in its model
    ModelJoint joint;
  };
  int root_ = 0;
  std::size_t part_count_ = 0;
  std::vector<Step> joints_in_order_;  ///< from the root outwards
};

}  // namespace oikos::model
