// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/link_layers.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace oikos::registration {

namespace {

render::View depthNormalsParts(const render::Scene& scene, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                               int threads) {
  render::ViewConfig config;
  config.with_normals = true;
  config.with_parts = true;
  config.threads = threads;
  return render::renderView(scene, render::CameraRays(camera), {T_map_camera, {}}, config);
}

Eigen::AlignedBox3d boxOf(const model::TriangleMesh& mesh_part, const Eigen::Isometry3d& T_link_part) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh_part.vertices) {
    box.extend(T_link_part * vertex.cast<double>());
  }
  return box;
}

/// The farthest vertex from a turning joint's axis, in the frame of its child at value 0.
double leverOf(const model::TriangleMesh& mesh_part, const Eigen::Isometry3d& T_link_part, const model::ModelJoint& joint) {
  double farthest_m = 0.0;
  for (const Eigen::Vector3f& vertex : mesh_part.vertices) {
    farthest_m = std::max(farthest_m, joint.axis_joint.cross(T_link_part * vertex.cast<double>()).norm());
  }
  return farthest_m;
}

bool isSeen(const model::ModelPart& part) {
  return part.mesh_part && !part.mesh_part->empty();
}

}  // namespace

LinkLayers::LinkLayers(const JointTree& tree, int threads) : tree_(tree), threads_(threads), layers_(tree.links().size()) {
  for (std::size_t link = 0; link < layers_.size(); ++link) {
    add(static_cast<int>(link));
  }
}

/// The base's branch would be all of the model: it is always seen alone.
void LinkLayers::add(int link) {
  Layer& layer = layers_[static_cast<std::size_t>(link)];
  for (std::size_t part = 0; part < tree_.model().parts.size(); ++part) {
    const int carrier = tree_.linkOf(static_cast<int>(part));
    const bool belongs = link == 0 ? carrier == 0 : tree_.hangsOn(carrier, link);
    if (belongs && isSeen(tree_.model().parts[part])) {
      layer.scene.add(tree_.model().parts[part].mesh_part, Eigen::Isometry3d::Identity());
      layer.parts.push_back(static_cast<int>(part));
    }
  }
}

void LinkLayers::pose(const std::vector<Eigen::Isometry3d>& T_model_part, bool with_branches) {
  for (std::size_t link = 0; link < layers_.size(); ++link) {
    Layer& layer = layers_[link];
    const Eigen::Isometry3d T_link_model = T_model_part[static_cast<std::size_t>(tree_.links()[link].parts.front())].inverse();
    layer.own_box.setEmpty();
    layer.box.setEmpty();
    layer.lever = link > 0 && tree_.jointOf(static_cast<int>(link)).type == model::MotionType::kRevolute ? 0.0 : 1.0;
    for (std::size_t i = 0; i < layer.parts.size(); ++i) {
      const auto part = static_cast<std::size_t>(layer.parts[i]);
      const model::TriangleMesh& mesh_part = *tree_.model().parts[part].mesh_part;
      const Eigen::Isometry3d T_link_part = T_link_model * T_model_part[part];
      const bool is_own = tree_.linkOf(static_cast<int>(part)) == static_cast<int>(link);
      layer.scene.move(static_cast<int>(i), T_link_part, {});
      layer.scene.show(static_cast<int>(i), is_own || with_branches);
      if (is_own) {
        layer.own_box.extend(boxOf(mesh_part, T_link_part));
      }
      if (is_own || with_branches) {
        layer.box.extend(boxOf(mesh_part, T_link_part));
      }
      if (is_own && link > 0 && tree_.jointOf(static_cast<int>(link)).type == model::MotionType::kRevolute) {
        layer.lever = std::max(layer.lever, leverOf(mesh_part, T_link_part, tree_.jointOf(static_cast<int>(link))));
      }
    }
    layer.scene.commit();
  }
}

WindowView LinkLayers::look(int link, const Eigen::Isometry3d& T_camera_link, const camera::PinholeCamera& camera) const {
  const Layer& layer = layers_[static_cast<std::size_t>(link)];
  WindowView seen;
  seen.window = windowAround(layer.box, T_camera_link, camera);
  if (!seen.window.isEmpty()) {
    seen.view = depthNormalsParts(layer.scene, cropped(camera, seen.window), T_camera_link.inverse(), threads_);
  }
  return seen;
}

WholeModel::WholeModel(const JointTree& tree, int threads) : threads_(threads) {
  for (std::size_t part = 0; part < tree.model().parts.size(); ++part) {
    if (isSeen(tree.model().parts[part])) {
      scene_.add(tree.model().parts[part].mesh_part, Eigen::Isometry3d::Identity());
      parts_.push_back(static_cast<int>(part));
    }
  }
}

void WholeModel::place(const std::vector<Eigen::Isometry3d>& T_map_part) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    scene_.move(static_cast<int>(i), T_map_part[static_cast<std::size_t>(parts_[i])], {});
  }
  scene_.commit();
}

render::View WholeModel::look(const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera) const {
  render::View view = depthNormalsParts(scene_, camera, T_map_camera, threads_);
  for (int v = 0; v < view.part.rows; ++v) {
    auto* row = view.part.ptr<int>(v);
    std::transform(row, row + view.part.cols, row, [&](int i) { return i < 0 ? -1 : parts_[static_cast<std::size_t>(i)]; });
  }
  return view;
}

}  // namespace oikos::registration
