// SPDX-License-Identifier: Apache-2.0
#include "tests/tracking/home_scene.h"

#include <memory>
#include <utility>

#include "core/model/primitives.h"
#include "semantic/model/home_models.h"
#include "semantic/model/placement.h"

namespace oikos::tracking {

void addFurniture(render::Scene& scene, const semantic::Home& home) {
  semantic::ModelMaker maker({});
  for (const semantic::LargeObject& object : home.rooms[0].objects) {
    scene.add(maker.make(object), object.T_map_object.toIsometry(), semantic::jointValues(object));
    for (const semantic::SmallObject& one : object.small_objects) {
      scene.add(maker.make(one), *semantic::findCarrierInMap(object, one.parent) * one.T_parent_object.toIsometry(), {});
    }
  }
}

void addBox(render::Scene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  model::TriangleMesh mesh = model::makeBoxBetween({low, high});
  mesh.materials.assign(1, {});
  mesh.materials[0].color_rgb = {0.7F, 0.7F, 0.65F};
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  scene.add(std::make_shared<const model::TriangleMesh>(std::move(mesh)), Eigen::Isometry3d::Identity());
}

}  // namespace oikos::tracking
