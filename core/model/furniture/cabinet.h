// SPDX-License-Identifier: Apache-2.0
// Cupboards, wardrobes, wall cupboards and drawer units from what a tape measure gives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/degrees.h"
#include "core/model/articulated_model.h"
#include "core/model/furniture/options.h"

namespace oikos::model {

/// `depth_m` is from the back to the face of the closed doors, without handles and the worktop's overhang; `height_m` from the underside to
/// the top of the worktop. The width is that of the body, the doors lie within it. Parts "door", or "left_door" and "right_door".
struct CabinetShape {
  double width_m = 0.60;
  double depth_m = 0.58;
  double height_m = 0.85;
  double bottom_m = 0.0;  ///< of the underside above the floor: a wall cupboard's
  double board_m = 0.018;
  double back_m = 0.008;
  double plinth_height_m = 0.10;
  int shelf_count = 1;
  int door_count = 1;                                  ///< 0, 1 or 2
  HingeEdge hinge = HingeEdge::kLeft;                  ///< of a single door; two hang at the left and the right
  double door_gap_m = 0.003;                           ///< between neighbouring doors; half of it at the body's edges
  double door_opening_rad = 110.0 * base::kRadPerDeg;  ///< the joints' upper limit; a bottom-hinged door stops level
  HandleStyle handle = HandleStyle::kBarVertical;
  double handle_length_m = 0.16;
  double handle_offset_m = 0.04;     ///< from the edge across from the hinge to the handle's middle, or its near end if it runs across
  double handle_level = 0.9;         ///< along the hinge: 0 the handle at the lower (left) end of the door, 1 at its upper (right) end
  double worktop_thickness_m = 0.0;  ///< 0: no worktop
  double worktop_overhang_m = 0.02;  ///< before the doors' face
  std::uint32_t body_rgb = 0xEDEBE6;
  std::uint32_t front_rgb = 0xD8CBB2;
  std::uint32_t handle_rgb = 0x8C9094;
  std::uint32_t plinth_rgb = 0x55524E;
  std::uint32_t worktop_rgb = 0x7A5C43;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("bottom_m", bottom_m);
    visitor.length("board_m", board_m).length("back_m", back_m).length("plinth_height_m", plinth_height_m);
    visitor.count("shelf_count", shelf_count).count("door_count", door_count).choice("hinge", hinge).length("door_gap_m", door_gap_m);
    visitor.angle("door_opening_deg", door_opening_rad).choice("handle", handle).length("handle_length_m", handle_length_m);
    visitor.length("handle_offset_m", handle_offset_m).ratio("handle_level", handle_level);
    visitor.length("worktop_thickness_m", worktop_thickness_m).length("worktop_overhang_m", worktop_overhang_m);
    visitor.color("body_rgb", body_rgb).color("front_rgb", front_rgb).color("handle_rgb", handle_rgb).color("plinth_rgb", plinth_rgb);
    visitor.color("worktop_rgb", worktop_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Throws ContractViolation for a shape that is not valid; so do all that follow.
[[nodiscard]] ArticulatedModel makeCabinet(const CabinetShape& shape);

/// As CabinetShape; parts "drawer_0" (the uppermost), "drawer_1", …
struct DrawerUnitShape {
  double width_m = 0.60;
  double depth_m = 0.58;
  double height_m = 0.85;
  double bottom_m = 0.0;
  double board_m = 0.018;
  double back_m = 0.008;
  double plinth_height_m = 0.10;
  int drawer_count = 3;
  std::vector<double> front_heights_m = {};  ///< of the fronts from above, scaled to fill the body; or none: all alike
  double drawer_gap_m = 0.003;
  double side_play_m = 0.013;    ///< between a drawer's box and the body, for the runners
  double extension_ratio = 0.8;  ///< how much of its box's depth a drawer comes out
  HandleStyle handle = HandleStyle::kBarHorizontal;
  double handle_length_m = 0.16;
  double worktop_thickness_m = 0.0;
  double worktop_overhang_m = 0.02;
  std::uint32_t body_rgb = 0xEDEBE6;
  std::uint32_t front_rgb = 0xD8CBB2;
  std::uint32_t drawer_rgb = 0xC9C6C0;
  std::uint32_t handle_rgb = 0x8C9094;
  std::uint32_t plinth_rgb = 0x55524E;
  std::uint32_t worktop_rgb = 0x7A5C43;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("bottom_m", bottom_m);
    visitor.length("board_m", board_m).length("back_m", back_m).length("plinth_height_m", plinth_height_m);
    visitor.count("drawer_count", drawer_count).lengths("front_heights_m", front_heights_m).length("drawer_gap_m", drawer_gap_m);
    visitor.length("side_play_m", side_play_m).ratio("extension_ratio", extension_ratio).choice("handle", handle);
    visitor.length("handle_length_m", handle_length_m).length("worktop_thickness_m", worktop_thickness_m);
    visitor.length("worktop_overhang_m", worktop_overhang_m).color("body_rgb", body_rgb).color("front_rgb", front_rgb);
    visitor.color("drawer_rgb", drawer_rgb).color("handle_rgb", handle_rgb).color("plinth_rgb", plinth_rgb);
    visitor.color("worktop_rgb", worktop_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

[[nodiscard]] ArticulatedModel makeDrawerUnit(const DrawerUnitShape& shape);

}  // namespace oikos::model
