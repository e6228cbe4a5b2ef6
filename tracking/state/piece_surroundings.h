// SPDX-License-Identifier: Apache-2.0
// What stands about a piece of furniture, as far as the home knows.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/render/scene.h"
#include "registration/articulated/surroundings.h"
#include "semantic/model/home.h"
#include "tracking/state/articulated_pieces.h"

namespace oikos::tracking {

/// Furniture as it is believed to stand, walls and floors, ready to be rendered without one of the pieces. Immutable, so thread-safe.
class HomeSurroundings {
 public:
  /// Throws Error for a model that cannot be made.
  HomeSurroundings(const semantic::Home& home, const std::filesystem::path& home_folder);

  /// A scene of all that is within reach of the piece and is not the piece; nor a wall that it stands in: a door's wall has an opening
  /// there.
  [[nodiscard]] render::Scene sceneWithout(const ArticulatedPiece& piece) const;

 private:
  struct Thing {
    std::string id;  ///< empty: a wall or a floor
    model::ArticulatedModel model;
    Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
    std::vector<double> joint_values;
    Eigen::AlignedBox3d box_model;
    bool is_wall = false;
  };
  void addShell(const semantic::Room& room);

  std::vector<Thing> things_;
};

/// What the scan's camera sees of a scene, each surface where the scan has it.
[[nodiscard]] registration::Surroundings surroundingsIn(const render::Scene& scene, const registration::Scan& scan,
                                                        const Eigen::Isometry3d& T_map_camera);

}  // namespace oikos::tracking
