// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/piece_surroundings.h"

#include "core/model/primitives.h"
#include "core/render/view.h"
#include "semantic/model/home_models.h"
#include "tracking/furniture/changed_pieces.h"
#include "tracking/localisation/room_walls.h"

namespace oikos::tracking {

namespace {

constexpr double kReach_m = 1.5;       // beyond, nothing of a piece's doors and drawers is mistaken for anything
constexpr double kInWall_m = 0.02;     // a piece that goes into a wall by less stands before it
constexpr double kThickness_m = 0.01;  // of a floor

model::ArticulatedModel modelOf(model::TriangleMesh mesh) {
  model::ArticulatedModel model;
  model.parts.push_back({"shell", std::make_shared<const model::TriangleMesh>(std::move(mesh))});
  return model;
}

/// The box along the other frame's axes around a box.
Eigen::AlignedBox3d inMap(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_map_box) {
  Eigen::AlignedBox3d box_map;
  for (int i = 0; i < 8; ++i) {
    box_map.extend(T_map_box * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  return box_map;
}

}  // namespace

HomeSurroundings::HomeSurroundings(const semantic::Home& home, const std::filesystem::path& home_folder) {
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    if (!room.outline_map.empty()) {
      addShell(room);
    }
    for (const semantic::LargeObject& object : room.objects) {
      if (object.movability == semantic::Movability::kMovable) {
        continue;
      }
      Thing thing{object.id.value, maker.make(object), object.T_map_object.toIsometry(), semantic::jointValues(object), {}, false};
      thing.box_model = boxOf(thing.model, {thing.joint_values});
      things_.push_back(std::move(thing));
    }
  }
}

void HomeSurroundings::addShell(const semantic::Room& room) {
  Eigen::AlignedBox2d around;
  for (const RoomWall& wall : wallsOf(room.outline_map, 0.0)) {
    Thing thing{{}, modelOf(wall.mesh_wall), wall.T_map_wall, {}, {}, true};
    thing.box_model = boxOf(thing.model, {{}});
    things_.push_back(std::move(thing));
  }
  for (const Eigen::Vector2d& corner : room.outline_map) {
    around.extend(corner);
  }
  const Eigen::Vector3d size(around.sizes().x(), around.sizes().y(), kThickness_m);
  Thing floor{{}, modelOf(model::makeBox(size.cast<float>())), Eigen::Isometry3d::Identity(), {}, {}, false};
  floor.T_map_model.translation() = Eigen::Vector3d(around.center().x(), around.center().y(), -0.5 * kThickness_m);
  floor.box_model = boxOf(floor.model, {{}});
  things_.push_back(std::move(floor));
}

render::Scene HomeSurroundings::sceneWithout(const ArticulatedPiece& piece) const {
  render::Scene scene;
  Eigen::AlignedBox3d within = piece.body_model;
  within.min().array() += kInWall_m;
  within.max().array() -= kInWall_m;
  const Eigen::AlignedBox3d reach_map = [&] {
    Eigen::AlignedBox3d box = inMap(piece.box_model, piece.believed.T_map_model);
    box.min().array() -= kReach_m;
    box.max().array() += kReach_m;
    return box;
  }();
  for (const Thing& thing : things_) {
    const bool is_itself = thing.id == piece.id.value;
    const bool is_near = reach_map.intersects(inMap(thing.box_model, thing.T_map_model));
    const bool is_around =
        thing.is_wall && within.intersects(inMap(thing.box_model, piece.believed.T_map_model.inverse() * thing.T_map_model));
    if (!is_itself && is_near && !is_around) {
      scene.add(thing.model, thing.T_map_model, thing.joint_values);
    }
  }
  scene.commit();
  return scene;
}

registration::Surroundings surroundingsIn(const render::Scene& scene, const registration::Scan& scan,
                                          const Eigen::Isometry3d& T_map_camera) {
  if (scene.modelCount() == 0) {
    return {};
  }
  render::ViewConfig config;
  config.with_normals = true;
  config.with_parts = true;
  return registration::surroundingsOf(render::renderView(scene, render::CameraRays(scan.camera), {T_map_camera, {}}, config), scan);
}

}  // namespace oikos::tracking
