// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_tree.h"

#include <algorithm>
#include <deque>
#include <utility>

namespace oikos::registration {

namespace {

/// A knob is read from its picture, not from the depth of a body that looks the same however it is turned.
bool isEstimated(const model::ArticulatedModel& model, const model::ModelJoint& joint) {
  const bool is_knob =
      std::any_of(model.knobs.begin(), model.knobs.end(), [&](const model::ModelKnob& knob) { return knob.part == joint.child; });
  return joint.type != model::MotionType::kFixed && !is_knob && joint.upper > joint.lower;
}

}  // namespace

JointTree::JointTree(model::ArticulatedModel model) : model_(std::move(model)), kinematics_(model_), link_of_(model_.parts.size(), -1) {
  grow(kinematics_.root());
}

void JointTree::grow(int root) {
  links_.push_back({.joint = -1, .parent = -1, .parts = {root}, .chain = {}});
  link_of_[static_cast<std::size_t>(root)] = 0;
  std::deque<int> parts = {root};
  for (; !parts.empty(); parts.pop_front()) {
    const int carrier = link_of_[static_cast<std::size_t>(parts.front())];
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      const model::ModelJoint& joint = model_.joints[j];
      if (joint.parent != parts.front()) {
        continue;
      }
      int link = carrier;
      if (isEstimated(model_, joint)) {
        link = static_cast<int>(links_.size());
        Link added{.joint = static_cast<int>(j), .parent = carrier, .parts = {}, .chain = links_[static_cast<std::size_t>(carrier)].chain};
        added.chain.push_back(link);
        links_.push_back(std::move(added));
      }
      links_[static_cast<std::size_t>(link)].parts.push_back(joint.child);
      link_of_[static_cast<std::size_t>(joint.child)] = link;
      parts.push_back(joint.child);
    }
  }
}

const model::ModelJoint& JointTree::jointOf(int link) const {
  return model_.joints[static_cast<std::size_t>(links_[static_cast<std::size_t>(link)].joint)];
}

bool JointTree::isNested() const {
  return std::any_of(links_.begin(), links_.end(), [](const Link& link) { return link.chain.size() > 1; });
}

bool JointTree::hangsOn(int link, int ancestor) const {
  const std::vector<int>& chain = links_[static_cast<std::size_t>(link)].chain;
  return ancestor == 0 || std::find(chain.begin(), chain.end(), ancestor) != chain.end();
}

std::vector<JointAxis> JointTree::axes(const Eigen::Isometry3d& T_map_model, const std::vector<Eigen::Isometry3d>& T_model_part) const {
  std::vector<JointAxis> axes(links_.size());
  for (std::size_t link = 1; link < links_.size(); ++link) {
    const model::ModelJoint& joint = jointOf(static_cast<int>(link));
    const Eigen::Isometry3d T_map_joint = T_map_model * T_model_part[static_cast<std::size_t>(joint.parent)] * joint.T_parent_joint;
    axes[link] = {joint.type == model::MotionType::kRevolute, T_map_joint.translation(), T_map_joint.linear() * joint.axis_joint};
  }
  return axes;
}

}  // namespace oikos::registration
