// SPDX-License-Identifier: Apache-2.0
// Cupboards, wardrobes, wall cupboards and drawer units from what a tape measure gives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
  int door_count = 1;                  ///< 0, 1 or 2
  HingeEdge hinge = HingeEdge::kLeft;  ///< of a single door; two hang at the left and the right
  double door_gap_m = 0.003;           ///< between neighbouring doors; half of it at the body's edges
  double door_opening_rad = 1.9;       ///< the joints' upper limit; a door that is hinged at its bottom stops level at the latest
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

  [[nodiscard]] std::vector<std::string> validate() const;
};

[[nodiscard]] ArticulatedModel makeDrawerUnit(const DrawerUnitShape& shape);

}  // namespace oikos::model
