// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::simulate {

/// A wall as it is believed and as it truly stands, seen from within its room: along x from its middle, y into the room.
struct TurnedWall {
  Eigen::Isometry2d T_map_believed = Eigen::Isometry2d::Identity();
  Eigen::Isometry2d T_map_true = Eigen::Isometry2d::Identity();
  double length_m = 0.0;
};

/// Of a room before and after its walls have turned: corner by corner the same outline.
[[nodiscard]] std::vector<TurnedWall> turnedWalls(const std::vector<Eigen::Vector2d>& believed_map,
                                                  const std::vector<Eigen::Vector2d>& true_map);

/// Moves what stands or hangs along a wall as the wall has moved; the rest stays.
void followWalls(semantic::LargeObject& object, const std::vector<TurnedWall>& walls);
/// The same for a door, by the mean of the walls on both sides that it stands in.
void followDoorway(semantic::LargeObject& door, const std::vector<TurnedWall>& walls);
/// Moves a piece out of the walls that it reaches into deeper than `believed` does. Pieces of model files stay: their size is not known.
void keepOutOfWalls(semantic::LargeObject& object, const semantic::LargeObject& believed, const std::vector<TurnedWall>& walls);
/// Whether it hangs flat on a wall above the floor, as a picture does.
[[nodiscard]] bool hangsOnWall(const semantic::LargeObject& object, const std::vector<TurnedWall>& walls);

}  // namespace oikos::simulate
