// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/world.h"

#include <cmath>
#include <set>

#include "core/base/parallel.h"
#include "semantic/model/home_models.h"
#include "semantic/model/placement.h"
#include "tools/simulate/dice.h"
#include "tools/simulate/dressing.h"
#include "tools/simulate/shell.h"
#include "tools/simulate/unmodelled.h"

namespace oikos::simulate {

namespace {

using semantic::Home;
using semantic::LargeObject;
using semantic::Room;
using semantic::SmallObject;

/// All small objects of a home with their place in map.
template <class Visit>
void forEachSmall(const Home& home, const Visit& visit) {
  for (const Room& room : home.rooms) {
    for (const SmallObject& small : room.small_objects) {
      visit(small, small.T_parent_object.toIsometry());
    }
    for (const LargeObject& object : room.objects) {
      for (const SmallObject& small : object.small_objects) {
        if (const auto T_map_parent = semantic::findCarrierInMap(object, small.parent)) {
          visit(small, *T_map_parent * small.T_parent_object.toIsometry());
        }
      }
    }
  }
}

/// The doorways that room doors stand in.
std::vector<WallOpening> openingsOf(const Home& home, semantic::ModelMaker& maker) {
  std::vector<WallOpening> openings;
  for (const Room& room : home.rooms) {
    for (const LargeObject& object : room.objects) {
      if (object.type != "door") {
        continue;
      }
      const model::ArticulatedModel door = maker.make(object);
      const Eigen::AlignedBox3f frame = door.parts.front().mesh_part->bounds();
      const Eigen::Isometry3d T = object.T_map_object.toIsometry();
      const auto side = [&](double y_m) { return Eigen::Vector2d((T * Eigen::Vector3d(0.0, y_m, 0.0)).head<2>()); };
      openings.push_back({side(frame.min().y()), side(frame.max().y()), frame.max().z()});
    }
  }
  return openings;
}

double areaOf(const std::vector<Eigen::Vector2d>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& next = outline[(i + 1) % outline.size()];
    twice += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return 0.5 * std::abs(twice);
}

/// A piece on its way into the scene.
struct Draft {
  std::string id;
  std::string type;
  std::uint64_t seed = 0;
  bool is_small = false;
  model::ArticulatedModel model;
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
  std::vector<double> joint_values;
};

std::vector<Draft> draftsOf(const Home& home, const WorldLook& look) {
  semantic::ModelMaker maker(look.home_folder);
  std::vector<Draft> drafts;
  for (const Room& room : home.rooms) {
    for (const LargeObject& object : room.objects) {
      Draft draft{object.id.value,
                  object.type,
                  look.seed + hashOf(object.id.value),
                  false,
                  maker.make(object),
                  object.T_map_object.toIsometry(),
                  semantic::jointValues(object)};
      if (object.type != "door" && Dice(draft.seed + 1).next() < look.extra_part_share) {
        addUnmodelledPart(draft.model, draft.seed);
      }
      drafts.push_back(std::move(draft));
    }
  }
  forEachSmall(home, [&](const SmallObject& small, const Eigen::Isometry3d& T_map_object) {
    drafts.push_back({small.id.value, small.type, look.seed + hashOf(small.id.value), true, maker.make(small), T_map_object, {}});
  });
  return drafts;
}

}  // namespace

World::World(const Home& home, const WorldLook& look) {
  addRooms(home, look);
  std::vector<Draft> drafts = draftsOf(home, look);
  base::parallelFor(static_cast<int>(drafts.size()), look.threads, [&](int i) {
    Draft& draft = drafts[static_cast<std::size_t>(i)];
    dress(draft.model, draft.type, draft.seed);
  });
  for (Draft& draft : drafts) {
    const int number = scene_.add(draft.model, draft.T_map_model, draft.joint_values);
    for (const model::ModelPart& part : draft.model.parts) {
      part_names_[number].push_back({draft.id, part.name});
    }
    if (draft.is_small) {
      small_[draft.id] = {draft.id, number, draft.T_map_model, true};
    } else {
      pieces_[draft.id] = {number, draft.T_map_model, std::move(draft.joint_values), true};
    }
  }
  scene_.commit();
}

void World::addRooms(const Home& home, const WorldLook& look) {
  semantic::ModelMaker maker(look.home_folder);
  const std::vector<WallOpening> openings = openingsOf(home, maker);
  auto thresholds = std::make_shared<model::TriangleMesh>();
  for (const WallOpening& opening : openings) {
    append(*thresholds, makeThreshold(opening), Eigen::Isometry3d::Identity());
  }
  for (model::Material& material : thresholds->materials) {
    material.color_rgb = {0.35F, 0.26F, 0.18F};
  }
  if (!thresholds->empty()) {
    scene_.add(thresholds, Eigen::Isometry3d::Identity());
  }
  std::vector<std::shared_ptr<model::TriangleMesh>> shells(home.rooms.size());
  base::parallelFor(static_cast<int>(shells.size()), look.threads, [&](int i) {
    const Room& room = home.rooms[static_cast<std::size_t>(i)];
    if (room.outline_map.size() >= 3) {
      auto shell = std::make_shared<model::TriangleMesh>(makeShell({room.outline_map, openings, look.wall_height_m}));
      dressShell(*shell, room.type, look.seed + hashOf(room.id.value));
      shells[static_cast<std::size_t>(i)] = std::move(shell);
    }
  });
  for (const std::shared_ptr<model::TriangleMesh>& shell : shells) {
    if (shell) {
      scene_.add(shell, Eigen::Isometry3d::Identity());
    }
  }
}

void World::update(const Home& home) {
  std::set<std::string> there;
  const auto place = [&](auto& piece, bool has_moved, const auto& move) {
    if (!piece.is_shown) {
      scene_.show(piece.model, true);
      piece.is_shown = true;
    }
    if (has_moved) {
      move();
    }
  };
  for (const Room& room : home.rooms) {
    for (const LargeObject& object : room.objects) {
      Piece& piece = pieces_.at(object.id.value);
      there.insert(object.id.value);
      const Eigen::Isometry3d T_map_model = object.T_map_object.toIsometry();
      std::vector<double> values = semantic::jointValues(object);
      place(piece, values != piece.joint_values || T_map_model.matrix() != piece.T_map_model.matrix(), [&] {
        piece.T_map_model = T_map_model;
        piece.joint_values = std::move(values);
        scene_.move(piece.model, T_map_model, piece.joint_values);
      });
    }
  }
  forEachSmall(home, [&](const SmallObject& small, const Eigen::Isometry3d& T_map_object) {
    SmallPiece& piece = small_.at(small.id.value);
    there.insert(small.id.value);
    place(piece, T_map_object.matrix() != piece.T_map_object.matrix(), [&] {
      piece.T_map_object = T_map_object;
      scene_.move(piece.model, T_map_object, {});
    });
  });
  const auto hideTheRest = [&](auto& pieces) {
    for (auto& [id, piece] : pieces) {
      if (piece.is_shown && there.count(id) == 0) {
        scene_.show(piece.model, false);
        piece.is_shown = false;
      }
    }
  };
  hideTheRest(pieces_);
  hideTheRest(small_);
  scene_.commit();
}

std::vector<World::PartName> World::partNames() const {
  std::vector<PartName> names;
  for (const render::ScenePart& part : scene_.parts()) {
    const auto of_model = part_names_.find(part.model);
    names.push_back(of_model == part_names_.end() ? PartName{} : of_model->second[static_cast<std::size_t>(part.part)]);
  }
  return names;
}

std::vector<Eigen::AlignedBox2d> World::footprints() const {
  std::set<int> models;
  for (const auto& [id, piece] : pieces_) {
    models.insert(piece.model);
  }
  std::vector<Eigen::AlignedBox2d> footprints_map;
  for (const render::ScenePart& part : scene_.parts()) {
    if (models.count(part.model) == 0) {
      continue;
    }
    const Eigen::AlignedBox3d bounds_map = part.mesh_part->bounds().cast<double>().transformed(part.T_map_part);
    footprints_map.emplace_back(bounds_map.min().head<2>(), bounds_map.max().head<2>());
  }
  return footprints_map;
}

std::vector<render::PointLight> ceilingLamps(const Home& home, double wall_height_m) {
  constexpr float kReach_m = 7.0F;
  std::vector<render::PointLight> lamps;
  for (const Room& room : home.rooms) {
    if (room.outline_map.size() < 3) {
      continue;
    }
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : room.outline_map) {
      middle += corner / static_cast<double>(room.outline_map.size());
    }
    const double brightness = std::sqrt(areaOf(room.outline_map)) * 0.45;
    lamps.push_back(
        {{middle.x(), middle.y(), wall_height_m - 0.25}, Eigen::Vector3f(1.0F, 0.96F, 0.9F) * static_cast<float>(brightness), kReach_m});
  }
  return lamps;
}

}  // namespace oikos::simulate
