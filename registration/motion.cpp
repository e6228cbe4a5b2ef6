// SPDX-License-Identifier: Apache-2.0
#include "registration/motion.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/geometry/se3.h"

namespace oikos::registration {

namespace {

Twists basisOf(PoseFreedom freedom) {
  if (freedom == PoseFreedom::kRigid) {
    return Eigen::Matrix<double, 6, 6>::Identity();
  }
  Twists planar = Twists::Zero(6, 3);
  planar(0, 0) = 1.0;
  planar(1, 1) = 1.0;
  planar(5, 2) = 1.0;
  return planar;
}

std::vector<DegreeOfFreedom> freedomsOf(PoseFreedom freedom) {
  if (freedom == PoseFreedom::kRigid) {
    return {{"x", false}, {"y", false}, {"z", false}, {"roll", true}, {"pitch", true}, {"yaw", true}};
  }
  return {{"x", false}, {"y", false}, {"yaw", true}};
}

void appendPose(const Eigen::Isometry3d& T, std::vector<double>& state) {
  const Eigen::Map<const Eigen::Matrix<double, 16, 1>> numbers(T.data());
  state.insert(state.end(), numbers.begin(), numbers.end());
}

Eigen::Isometry3d poseFrom(const std::vector<double>& state) {
  Eigen::Isometry3d T;
  std::copy_n(state.begin(), 16, T.data());
  return T;
}

/// Middle of what a model shows in its frame.
Eigen::Vector3d middleOf(const model::ArticulatedModel& model, const std::vector<Eigen::Isometry3d>& T_model_part) {
  Eigen::AlignedBox3d box;
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    if (model.parts[part].mesh_part) {
      for (const Eigen::Vector3f& vertex : model.parts[part].mesh_part->vertices) {
        box.extend(T_model_part[part] * vertex.cast<double>());
      }
    }
  }
  return box.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
}

/// Whether a joint moves a part: the joint is on the way from the part to the root.
std::vector<std::vector<char>> movedParts(const model::ArticulatedModel& model) {
  std::vector<int> joint_of(model.parts.size(), -1);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    joint_of[static_cast<std::size_t>(model.joints[j].child)] = static_cast<int>(j);
  }
  std::vector<std::vector<char>> moved(model.joints.size(), std::vector<char>(model.parts.size(), 0));
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    for (int j = joint_of[part]; j >= 0; j = joint_of[static_cast<std::size_t>(model.joints[static_cast<std::size_t>(j)].parent)]) {
      moved[static_cast<std::size_t>(j)][part] = 1;
    }
  }
  return moved;
}

/// How a joint moves what hangs on it, about a pivot.
geometry::Vector6d jointTwist(const model::ModelJoint& joint, const Eigen::Isometry3d& T_map_joint, const Eigen::Vector3d& pivot_map) {
  const Eigen::Vector3d axis_map = T_map_joint.linear() * joint.axis_joint;
  geometry::Vector6d twist = geometry::Vector6d::Zero();
  if (joint.type == model::MotionType::kPrismatic) {
    twist.head<3>() = axis_map;
  } else {
    twist.head<3>() = axis_map.cross(pivot_map - T_map_joint.translation());
    twist.tail<3>() = axis_map;
  }
  return twist;
}

}  // namespace

Eigen::Isometry3d motionAbout(const Eigen::Vector3d& pivot_map, const Eigen::Matrix<double, 6, 1>& twist) {
  Eigen::Isometry3d about = Eigen::Isometry3d::Identity();
  about.linear() = geometry::expSo3(twist.tail<3>());
  about.translation() = pivot_map + twist.head<3>() - about.linear() * pivot_map;
  return about;
}

CameraMotion::CameraMotion(const render::Scene& scene, const Eigen::Isometry3d& T_map_camera, PoseFreedom freedom,
                           const Eigen::Vector3d& pivot_camera)
    : scene_(scene), T_map_camera_(T_map_camera), pivot_camera_(pivot_camera), basis_(basisOf(freedom)), freedoms_(freedomsOf(freedom)) {}

/// Where the camera goes one way, the scene before it goes the other.
Twists CameraMotion::twistsOf(int) const {
  return -basis_;
}

void CameraMotion::apply(const Step& step) {
  T_map_camera_ = motionAbout(pivot_map(), basis_ * step) * T_map_camera_;
}

std::vector<double> CameraMotion::saved() const {
  std::vector<double> state;
  appendPose(T_map_camera_, state);
  return state;
}

void CameraMotion::restore(const std::vector<double>& state) {
  T_map_camera_ = poseFrom(state);
}

ModelMotion::ModelMotion(render::Scene& scene, int number, const model::ArticulatedModel& articulated,
                         const Eigen::Isometry3d& T_map_camera, const Pose& start, Freedom freedom)
    : scene_(scene),
      number_(number),
      model_(articulated),
      kinematics_(articulated),
      T_map_camera_(T_map_camera),
      pose_(start),
      freedom_(std::move(freedom)) {
  pivot_model_ = middleOf(model_, kinematics_.solve(pose_.joint_values));
  basis_ = freedom_.base ? basisOf(freedom_.kind) : Twists(6, 0);
  freedoms_ = freedom_.base ? freedomsOf(freedom_.kind) : std::vector<DegreeOfFreedom>();
  for (const int number_of_joint : freedom_.joints) {
    const model::ModelJoint& joint = model_.joints[static_cast<std::size_t>(number_of_joint)];
    freedoms_.push_back({"joint " + joint.name, joint.type == model::MotionType::kRevolute});
  }
  moveTo(start);
}

void ModelMotion::moveTo(const Pose& pose) {
  pose_ = pose;
  scene_.move(number_, pose_.T_map_model, pose_.joint_values);
  scene_.commit();
  updateTwists();
}

Twists ModelMotion::twistsOf(int part) const {
  const render::ScenePart& seen = scene_.parts()[static_cast<std::size_t>(part)];
  return seen.model == number_ ? part_twists_[static_cast<std::size_t>(seen.part)] : Twists(Twists::Zero(6, dimension()));
}

void ModelMotion::updateTwists() {
  const std::vector<Eigen::Isometry3d> T_model_part = kinematics_.solve(pose_.joint_values);
  const std::vector<std::vector<char>> moved = movedParts(model_);
  part_twists_.assign(model_.parts.size(), Twists::Zero(6, dimension()));
  const auto base_columns = basis_.cols();
  for (std::size_t part = 0; part < model_.parts.size(); ++part) {
    part_twists_[part].leftCols(base_columns) = basis_;
  }
  for (std::size_t i = 0; i < freedom_.joints.size(); ++i) {
    const auto j = static_cast<std::size_t>(freedom_.joints[i]);
    const model::ModelJoint& joint = model_.joints[j];
    const Eigen::Isometry3d T_map_joint = pose_.T_map_model * T_model_part[static_cast<std::size_t>(joint.parent)] * joint.T_parent_joint;
    const geometry::Vector6d twist = jointTwist(joint, T_map_joint, pivot_map());
    for (std::size_t part = 0; part < model_.parts.size(); ++part) {
      if (moved[j][part] != 0) {
        part_twists_[part].col(base_columns + static_cast<Eigen::Index>(i)) = twist;
      }
    }
  }
}

void ModelMotion::apply(const Step& step) {
  Pose next = pose_;
  if (freedom_.base) {
    next.T_map_model = motionAbout(pivot_map(), basis_ * step.head(basis_.cols())) * pose_.T_map_model;
  }
  for (std::size_t i = 0; i < freedom_.joints.size(); ++i) {
    const auto j = static_cast<std::size_t>(freedom_.joints[i]);
    const model::ModelJoint& joint = model_.joints[j];
    next.joint_values[j] = std::clamp(pose_.joint_values[j] + step[basis_.cols() + static_cast<Eigen::Index>(i)], joint.lower, joint.upper);
  }
  moveTo(next);
}

std::vector<double> ModelMotion::saved() const {
  std::vector<double> state;
  appendPose(pose_.T_map_model, state);
  state.insert(state.end(), pose_.joint_values.begin(), pose_.joint_values.end());
  return state;
}

void ModelMotion::restore(const std::vector<double>& state) {
  moveTo({poseFrom(state), std::vector<double>(state.begin() + 16, state.end())});
}

}  // namespace oikos::registration
