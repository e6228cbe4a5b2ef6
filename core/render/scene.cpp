// SPDX-License-Identifier: Apache-2.0
#include "core/render/scene.h"

#include <map>
#include <utility>

#include "core/base/error.h"
#include "core/geometry/tone_curve.h"
#include "core/render/embree_scene.h"
#include "core/render/surface_table.h"
#include "core/render/texture.h"

namespace oikos::render {

namespace {

void requireValid(const model::TriangleMesh& mesh, const std::string& where) {
  if (const std::vector<std::string> problems = model::validate(mesh); !problems.empty()) {
    throw base::Error(base::ErrorCode::kInput, problems.front(), where);
  }
}

model::ArticulatedModel singlePart(std::shared_ptr<const model::TriangleMesh> mesh_model) {
  model::ArticulatedModel model;
  model.name = "mesh";
  model.parts.push_back({"mesh", std::move(mesh_model)});
  return model;
}

}  // namespace

struct Scene::Impl {
  struct PosedModel {
    model::Kinematics kinematics;
    std::vector<std::pair<int, std::size_t>> parts;  ///< number in the scene, index in the model
  };

  void addPart(int model, std::size_t part, std::shared_ptr<const model::TriangleMesh> mesh_part) {
    embree.addPart(*mesh_part);
    ScenePart added;
    added.model = model;
    added.part = static_cast<int>(part);
    added.surfaces = surfacesOf(*mesh_part);
    for (const model::Material& material : mesh_part->materials.empty() ? std::vector{model::Material{}} : mesh_part->materials) {
      added.looks.push_back({material.color_rgb.unaryExpr([](float srgb) { return geometry::lightOfSrgb(srgb); }), material.gloss,
                             pyramidOf(material.texture)});
    }
    added.mesh_part = std::move(mesh_part);
    parts.push_back(std::move(added));
  }

  std::shared_ptr<const TexturePyramid> pyramidOf(const cv::Mat& texture) {
    if (texture.empty()) {
      return nullptr;
    }
    std::shared_ptr<const TexturePyramid>& pyramid = pyramids[texture.data];
    if (!pyramid) {
      pyramid = std::make_shared<const TexturePyramid>(texture);
    }
    return pyramid;
  }

  std::shared_ptr<const std::vector<SurfaceTriangle>> surfacesOf(const model::TriangleMesh& mesh_part) {
    std::shared_ptr<const std::vector<SurfaceTriangle>>& table = surfaces[&mesh_part];
    if (!table) {
      table = std::make_shared<const std::vector<SurfaceTriangle>>(makeSurfaceTable(mesh_part));
    }
    return table;
  }

  EmbreeScene embree;
  std::vector<PosedModel> models;
  std::vector<ScenePart> parts;
  std::map<const unsigned char*, std::shared_ptr<const TexturePyramid>> pyramids;  ///< by pixels, which the parts' meshes keep alive
  std::map<const model::TriangleMesh*, std::shared_ptr<const std::vector<SurfaceTriangle>>> surfaces;
};

Scene::Scene() : impl_(std::make_unique<Impl>()) {}

Scene::~Scene() = default;

Scene::Scene(Scene&&) noexcept = default;

Scene& Scene::operator=(Scene&&) noexcept = default;

int Scene::add(const model::ArticulatedModel& model, const Eigen::Isometry3d& T_map_model, const std::vector<double>& joint_values) {
  const auto number = static_cast<int>(impl_->models.size());
  Impl::PosedModel posed{model::Kinematics(model), {}};
  for (const model::ModelPart& part : model.parts) {
    if (part.mesh_part) {
      requireValid(*part.mesh_part, model.name + ", part " + part.name);
    }
  }
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    if (model.parts[i].mesh_part && !model.parts[i].mesh_part->empty()) {
      posed.parts.emplace_back(static_cast<int>(impl_->parts.size()), i);
      impl_->addPart(number, i, model.parts[i].mesh_part);
    }
  }
  impl_->models.push_back(std::move(posed));
  move(number, T_map_model, joint_values);
  return number;
}

int Scene::add(std::shared_ptr<const model::TriangleMesh> mesh_model, const Eigen::Isometry3d& T_map_model) {
  return add(singlePart(std::move(mesh_model)), T_map_model, {});
}

void Scene::move(int model, const Eigen::Isometry3d& T_map_model, const std::vector<double>& joint_values) {
  const Impl::PosedModel& posed = impl_->models.at(static_cast<std::size_t>(model));
  const std::vector<Eigen::Isometry3d> T_model_parts = posed.kinematics.solve(joint_values);
  for (const auto& [number, index] : posed.parts) {
    ScenePart& part = impl_->parts[static_cast<std::size_t>(number)];
    const Eigen::Isometry3d T_map_part = T_map_model * T_model_parts[index];
    if (T_map_part.matrix() != part.T_map_part.matrix()) {
      part.T_map_part = T_map_part;
      impl_->embree.movePart(number, T_map_part);
    }
  }
}

void Scene::show(int model, bool is_shown) {
  for (const auto& [number, index] : impl_->models.at(static_cast<std::size_t>(model)).parts) {
    impl_->embree.showPart(number, is_shown);
  }
}

void Scene::commit() {
  impl_->embree.commit();
}

int Scene::modelCount() const {
  return static_cast<int>(impl_->models.size());
}

const std::vector<ScenePart>& Scene::parts() const {
  return impl_->parts;
}

const EmbreeScene& Scene::embree() const {
  return impl_->embree;
}

}  // namespace oikos::render
