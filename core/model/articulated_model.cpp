// SPDX-License-Identifier: Apache-2.0
#include "core/model/articulated_model.h"

#include <cmath>

#include "core/base/error.h"

namespace oikos::model {

namespace {

constexpr double kUnitTolerance = 1e-6;

[[noreturn]] void fail(const ArticulatedModel& model, const std::string& what) {
  throw base::Error(base::ErrorCode::kInput, what, "model '" + model.name + "'");
}

bool isRigid(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  return T.matrix().allFinite() && (R.transpose() * R).isApprox(Eigen::Matrix3d::Identity(), kUnitTolerance) && R.determinant() > 0.0;
}

bool isUnit(const Eigen::Vector3d& axis) {
  return axis.allFinite() && std::fabs(axis.norm() - 1.0) <= kUnitTolerance;
}

void checkPart(const ArticulatedModel& model, const std::string& what, int part) {
  if (part < 0 || part >= static_cast<int>(model.parts.size())) {
    fail(model, what + " names part " + std::to_string(part) + ": there are " + std::to_string(model.parts.size()) + ", counted from 0");
  }
}

void checkJoint(const ArticulatedModel& model, const ModelJoint& joint) {
  const std::string what = "joint '" + joint.name + "'";
  checkPart(model, what, joint.parent);
  checkPart(model, what, joint.child);
  if (!isRigid(joint.T_parent_joint)) {
    fail(model, what + " has an origin that is no rigid motion: must be a rotation and a finite translation");
  }
  if (joint.type == MotionType::kFixed) {
    return;
  }
  if (!isUnit(joint.axis_joint)) {
    fail(model, what + " has an axis of length " + std::to_string(joint.axis_joint.norm()) + ": must be 1");
  }
  if (!(joint.lower <= joint.upper)) {
    fail(model, what + " has limits from " + std::to_string(joint.lower) + " to " + std::to_string(joint.upper) +
                    ": the lower must not be above the upper");
  }
}

void checkHold(const ArticulatedModel& model) {
  for (const ModelHandle& handle : model.handles) {
    checkPart(model, "handle '" + handle.name + "'", handle.part);
    if (!isRigid(handle.T_part_handle)) {
      fail(model, "handle '" + handle.name + "' has a frame that is no rigid motion");
    }
  }
  for (const ModelKnob& knob : model.knobs) {
    checkPart(model, "knob '" + knob.name + "'", knob.part);
    if (!isRigid(knob.T_part_knob) || !isUnit(knob.axis_knob)) {
      fail(model, "knob '" + knob.name + "' must have a rigid motion as its frame and an axis of length 1");
    }
  }
}

void checkMeshes(const ArticulatedModel& model) {
  for (const ModelPart& part : model.parts) {
    const auto problems = part.mesh_part ? validate(*part.mesh_part) : std::vector<std::string>{};
    if (!problems.empty()) {
      fail(model, "the mesh of part '" + part.name + "' is wrong: " + problems.front());
    }
  }
}

/// The joint that leads to each part; -1 for the root.
std::vector<int> findLeadingJoints(const ArticulatedModel& model) {
  std::vector<int> leading(model.parts.size(), -1);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    int& joint = leading[static_cast<std::size_t>(model.joints[i].child)];
    if (joint >= 0) {
      fail(model, "part '" + model.parts[static_cast<std::size_t>(model.joints[i].child)].name + "' is the child of two joints, '" +
                      model.joints[static_cast<std::size_t>(joint)].name + "' and '" + model.joints[i].name + "': must be of one");
    }
    joint = static_cast<int>(i);
  }
  return leading;
}

int findRoot(const ArticulatedModel& model, const std::vector<int>& leading) {
  int root = -1;
  for (std::size_t part = 0; part < leading.size(); ++part) {
    if (leading[part] >= 0) {
      continue;
    }
    if (root >= 0) {
      fail(model, "has two roots, '" + model.parts[static_cast<std::size_t>(root)].name + "' and '" + model.parts[part].name +
                      "': all parts but one must be a joint's child");
    }
    root = static_cast<int>(part);
  }
  if (root < 0) {
    fail(model, model.parts.empty() ? "has no part" : "its joints lead round in a circle: one part must be no joint's child");
  }
  return root;
}

}  // namespace

Eigen::Isometry3d jointMotion(const ModelJoint& joint, double value) {
  Eigen::Isometry3d T_joint_child = Eigen::Isometry3d::Identity();
  if (joint.type == MotionType::kRevolute) {
    T_joint_child.linear() = Eigen::AngleAxisd(value, joint.axis_joint).toRotationMatrix();
  } else if (joint.type == MotionType::kPrismatic) {
    T_joint_child.translation() = value * joint.axis_joint;
  }
  return T_joint_child;
}

Kinematics::Kinematics(const ArticulatedModel& model) : part_count_(model.parts.size()) {
  for (const ModelJoint& joint : model.joints) {
    checkJoint(model, joint);
  }
  checkHold(model);
  checkMeshes(model);
  root_ = findRoot(model, findLeadingJoints(model));
  std::vector<std::vector<int>> joints_from(part_count_);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    joints_from[static_cast<std::size_t>(model.joints[i].parent)].push_back(static_cast<int>(i));
  }
  std::vector<int> parts_in_order = {root_};
  for (std::size_t next = 0; next < parts_in_order.size(); ++next) {
    for (const int index : joints_from[static_cast<std::size_t>(parts_in_order[next])]) {
      const ModelJoint& joint = model.joints[static_cast<std::size_t>(index)];
      joints_in_order_.push_back({index, joint});
      parts_in_order.push_back(joint.child);
    }
  }
  if (parts_in_order.size() != part_count_) {
    fail(model, "joints lead round in a circle: " + std::to_string(part_count_ - parts_in_order.size()) + " parts hang on no root");
  }
}

std::vector<Eigen::Isometry3d> Kinematics::solve(const std::vector<double>& joint_values) const {
  OIKOS_CHECK(joint_values.size() == joints_in_order_.size());
  std::vector<Eigen::Isometry3d> T_model_part(part_count_, Eigen::Isometry3d::Identity());
  for (const auto& [index, joint] : joints_in_order_) {
    const double value = joint_values[static_cast<std::size_t>(index)];
    OIKOS_CHECK(joint.type == MotionType::kFixed || std::isfinite(value));
    T_model_part[static_cast<std::size_t>(joint.child)] =
        T_model_part[static_cast<std::size_t>(joint.parent)] * joint.T_parent_joint * jointMotion(joint, value);
  }
  return T_model_part;
}

}  // namespace oikos::model
