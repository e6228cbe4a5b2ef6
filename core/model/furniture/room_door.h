// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/degrees.h"
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
  double door_opening_rad = 110.0 * base::kRadPerDeg;
  double lever_height_m = 1.05;
  double lever_length_m = 0.12;
  double lever_offset_m = 0.06;  ///< from the leaf's free edge to the lever's spindle
  std::uint32_t frame_rgb = 0xE9E6DF;
  std::uint32_t front_rgb = 0xF1EFEA;
  std::uint32_t handle_rgb = 0x8C9094;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("jamb_m", jamb_m);
    visitor.length("leaf_m", leaf_m).length("door_gap_m", door_gap_m).length("floor_gap_m", floor_gap_m).choice("hinge", hinge);
    visitor.angle("door_opening_deg", door_opening_rad).length("lever_height_m", lever_height_m).length("lever_length_m", lever_length_m);
    visitor.length("lever_offset_m", lever_offset_m).color("frame_rgb", frame_rgb).color("front_rgb", front_rgb);
    visitor.color("handle_rgb", handle_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeRoomDoor(const RoomDoorShape& shape);

}  // namespace oikos::model
