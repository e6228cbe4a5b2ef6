// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_scene.h"

#include <cstddef>

#include "core/base/error.h"

namespace oikos::registration {

namespace {

/// One a part: whether a joint that moves is on the way to the root.
std::vector<char> movingParts(const model::ArticulatedModel& model) {
  std::vector<const model::ModelJoint*> joint_of(model.parts.size(), nullptr);
  for (const model::ModelJoint& joint : model.joints) {
    joint_of[static_cast<std::size_t>(joint.child)] = &joint;
  }
  std::vector<char> moving(model.parts.size(), 0);
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    for (const model::ModelJoint* joint = joint_of[part]; joint != nullptr; joint = joint_of[static_cast<std::size_t>(joint->parent)]) {
      moving[part] = moving[part] != 0 || joint->type != model::MotionType::kFixed ? 1 : 0;
    }
  }
  return moving;
}

}  // namespace

int LandmarkScene::add(const std::string& id, const model::ArticulatedModel& model, const Eigen::Isometry3d& T_map_model,
                       const std::vector<double>& joint_values) {
  const std::vector<Eigen::Isometry3d> T_model_parts = model::Kinematics(model).solve(joint_values);
  const std::vector<char> moving = movingParts(model);
  const int landmark = static_cast<int>(ids_.size());
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    if (model.parts[part].mesh_part) {
      scene_.add(model.parts[part].mesh_part, T_map_model * T_model_parts[part]);
      surfaces_.push_back({landmark, model.parts[part].name, moving[part] == 0});
    }
  }
  ids_.push_back(id);
  scene_.commit();
  return landmark;
}

void LandmarkScene::show(const std::vector<char>& shown) {
  OIKOS_CHECK(shown.size() == surfaces_.size());
  for (std::size_t s = 0; s < shown.size(); ++s) {
    scene_.show(static_cast<int>(s), shown[s] != 0);
  }
  scene_.commit();
}

}  // namespace oikos::registration
