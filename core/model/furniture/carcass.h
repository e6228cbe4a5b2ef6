// SPDX-License-Identifier: Apache-2.0
// What cupboards, drawer units and appliances have in common: a hollow body of boards, open at its front (+x).
#pragma once

#include "core/model/furniture/builder.h"

namespace oikos::model {

struct Carcass {
  Eigen::AlignedBox3d outer_model;
  double board_m = 0.018;
  double back_m = 0.008;
  int shelf_count = 0;
  double shelf_m = 0.018;  ///< their thickness
  double shelf_set_back_m = 0.02;
  bool has_top = true;
  Finish finish;
  Finish shelf_finish;
};

/// Adds the boards to part 0; returns the hollow.
Eigen::AlignedBox3d addCarcass(FurnitureBuilder& builder, const Carcass& carcass);

/// A base of boards below `outer_model`, set back at its front.
void addPlinth(FurnitureBuilder& builder, const Eigen::AlignedBox3d& outer_model, double board_m, const Finish& finish);

constexpr double kBumper_m = 0.002;  ///< between a carcass and its closed front

}  // namespace oikos::model
