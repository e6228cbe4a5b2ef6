// SPDX-License-Identifier: Apache-2.0
// What is in a home and in no model of it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/model/articulated_model.h"
#include "semantic/model/home.h"
#include "tools/simulate/robot_path.h"

namespace oikos::simulate {

/// Adds a box of 4 to 12 cm to a piece's base part: on its front, on a side or on its top, by `seed`. Not to a piece without a mesh.
void addUnmodelledPart(model::ArticulatedModel& piece, std::uint64_t seed);

struct LooseBox {
  model::ArticulatedModel model;
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
};

/// Where boxes may lie.
struct FreeFloor {
  std::vector<Eigen::AlignedBox2d> footprints_map;  ///< of what stands there
  double until_s = 0.0;                             ///< the robot's way up to then is kept free
  double beside_path_m = 0.4;                       ///< so far from its base
};

/// `count` boxes on the floors of the home's rooms, or as many as find a free place.
[[nodiscard]] std::vector<LooseBox> scatterBoxes(const semantic::Home& home, const RobotPath& path, FreeFloor floor, int count,
                                                 std::uint64_t seed);

}  // namespace oikos::simulate
