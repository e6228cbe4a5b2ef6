// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_scene.h"

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/render/view.h"

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
      whole_.add(model.parts[part].mesh_part, T_map_model * T_model_parts[part]);
      surface_of_whole_.push_back(static_cast<int>(surfaces_.size()));
      surfaces_.push_back({landmark, model.parts[part].name, moving[part] == 0});
    }
  }
  ids_.push_back(id);
  scene_.commit();
  whole_.commit();
  return landmark;
}

void LandmarkScene::addOccluder(const model::TriangleMesh& mesh_map) {
  whole_.add(std::make_shared<const model::TriangleMesh>(mesh_map), Eigen::Isometry3d::Identity());
  surface_of_whole_.push_back(-1);
  whole_.commit();
}

std::vector<int> LandmarkScene::countInView(const Scan& scan, const Eigen::Isometry3d& T_map_camera, int threads) const {
  render::ViewConfig config;
  config.with_parts = true;
  config.threads = threads;
  const render::View view = render::renderView(whole_, render::CameraRays(scan.camera), {T_map_camera, {}}, config);
  std::vector<int> pixels(surfaces_.size(), 0);
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      const int part = view.part.at<int>(v, u);
      if (part < 0 || scan.at(u, v).point_camera.z() <= 0.0F) {
        continue;
      }
      const int surface = surface_of_whole_[static_cast<std::size_t>(whole_.parts()[static_cast<std::size_t>(part)].model)];
      if (surface >= 0) {
        ++pixels[static_cast<std::size_t>(surface)];
      }
    }
  }
  return pixels;
}

void LandmarkScene::show(const std::vector<char>& shown) {
  OIKOS_CHECK(shown.size() == surfaces_.size());
  for (std::size_t s = 0; s < shown.size(); ++s) {
    scene_.show(static_cast<int>(s), shown[s] != 0);
  }
  scene_.commit();
}

}  // namespace oikos::registration
