// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/render/lighting.h"
#include "core/render/scene.h"
#include "semantic/model/home.h"

namespace oikos::simulate {

/// How a home looks beside what it says itself.
struct WorldLook {
  std::filesystem::path home_folder;  ///< of the model files
  std::uint64_t seed = 0;             ///< of materials
  double wall_height_m = 2.5;
  double extra_part_share = 0.0;  ///< of the pieces of furniture with a part that no model has
  int threads = 1;                ///< to make the materials with; the same bytes for any number
};

/// A home with its walls, floors and materials, ready to be looked at.
class World {
 public:
  /// Throws Error for a piece that cannot be made.
  World(const semantic::Home& home, const WorldLook& look);

  /// Brings everything to where `home` has it: the same home in another state. What it lacks is not shown.
  void update(const semantic::Home& home);
  /// What the furniture covers of the floor, part by part, as it stands now.
  [[nodiscard]] std::vector<Eigen::AlignedBox2d> footprints() const;
  /// Something that is not of the home: a person, clutter. Returns its number in the scene.
  int add(const model::ArticulatedModel& model, const Eigen::Isometry3d& T_map_model) { return scene_.add(model, T_map_model, {}); }
  render::Scene& scene() { return scene_; }
  [[nodiscard]] const render::Scene& scene() const { return scene_; }

  struct PartName {
    std::string id;    ///< of the piece or small object; empty: a room's shell, a person, clutter
    std::string part;  ///< in its model
  };
  /// Of the parts of scene(), in their order.
  [[nodiscard]] std::vector<PartName> partNames() const;

  struct SmallPiece {
    std::string id;
    int model = 0;  ///< in the scene
    Eigen::Isometry3d T_map_object = Eigen::Isometry3d::Identity();
    bool is_shown = true;
  };
  /// The small objects, by their ids.
  [[nodiscard]] const std::map<std::string, SmallPiece>& smallPieces() const { return small_; }

 private:
  struct Piece {
    int model = 0;
    Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
    std::vector<double> joint_values;
    bool is_shown = true;
  };
  void addRooms(const semantic::Home& home, const WorldLook& look);

  render::Scene scene_;
  std::map<int, std::vector<PartName>> part_names_;  ///< by model, then by part of the model
  std::map<std::string, Piece> pieces_;
  std::map<std::string, SmallPiece> small_;
};

/// A lamp below the ceiling of each room, as bright as it is large.
[[nodiscard]] std::vector<render::PointLight> ceilingLamps(const semantic::Home& home, double wall_height_m);

}  // namespace oikos::simulate
