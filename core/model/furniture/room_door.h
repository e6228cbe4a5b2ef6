// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/model/furniture/options.h"

namespace oikos::model {

/// A door in its frame. Its front (+x) is the side to which it opens; sizes are the frame's outer ones, the depth being the wall's.
/// Part "door", with a lever on either side: handles "front_lever" and "back_lever".
struct RoomDoorShape {
  double width_m = 0.98;
  double depth_m = 0.14;
  double height_m = 2.05;
  double jamb_m = 0.04;
  double leaf_m = 0.04;
  double door_gap_m = 0.004;
  double floor_gap_m = 0.008;
  HingeEdge hinge = HingeEdge::kLeft;  ///< left or right, seen from the front
  double door_opening_rad = 1.9;
  double lever_height_m = 1.05;
  double lever_length_m = 0.12;
  double lever_offset_m = 0.06;  ///< from the leaf's free edge to the lever's spindle
  std::uint32_t frame_rgb = 0xE9E6DF;
  std::uint32_t front_rgb = 0xF1EFEA;
  std::uint32_t handle_rgb = 0x8C9094;

  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeRoomDoor(const RoomDoorShape& shape);

}  // namespace oikos::model
