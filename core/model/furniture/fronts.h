// SPDX-License-Identifier: Apache-2.0
// Doors with their handles, as cupboards and appliances have them.
#pragma once

#include "core/model/furniture/builder.h"

namespace oikos::model {

struct HandleRule {
  HandleStyle style = HandleStyle::kBarVertical;
  double length_m = 0.16;
  double offset_m = 0.04;
  double level = 0.9;
};

/// Where on a closed front the handle goes: `offset_m` from the edge across from the hinge, at `level` along it.
[[nodiscard]] HandlePlace placeHandle(const HingedFront& front, const HandleRule& rule);

/// Whether it lies within the front with its whole length.
[[nodiscard]] bool handleFits(const HingedFront& front, const HandleRule& rule);

/// What the edge across from the hinge needs beside it to turn past its neighbour: the front's diagonal is longer than its side.
[[nodiscard]] double turningRoom(const HingedFront& front);

/// Adds a door of one board with its handle; returns its part.
int addBoardDoor(FurnitureBuilder& builder, const HingedFront& front, const HandleRule& rule, const Finish& front_finish,
                 const Finish& handle_finish);

/// The same front with each of its edges this much further in (y and z).
[[nodiscard]] Eigen::AlignedBox3d shrunk(const Eigen::AlignedBox3d& front_model, double margin_m);

}  // namespace oikos::model
